// The state of CanOdometer that outlives the process.

#include <cmath>

#include "drivers/can/can_odometer.hpp"

namespace azimuth {
namespace {

// Layout of OdometerMemory::numbers: four for each channel, the channels at the last reading, and a signature of the
// signals.
constexpr std::size_t kOfChannel = 4, kLast = 12, kSignature = 15;
constexpr double kLongest_s = 1e6;  // largest time between the channels

/// True: all stored real numbers can be used for computation.
bool is_sane(const OdometerMemory& memory) {
  for (std::size_t i = 0; i < kSignature; ++i) {
    const bool is_raw = i < kLast && i % kOfChannel == 0, is_time = i < kLast && i % kOfChannel == 2;
    if (!is_raw && !std::isfinite(memory.real(i))) return false;
    if (is_time && std::abs(memory.real(i)) > kLongest_s) return false;
  }
  return true;
}

}  // namespace

std::uint64_t CanOdometer::signature() const { return 10 * static_cast<std::uint64_t>(kind_) + channels_.size(); }

bool CanOdometer::remember(OdometerMemory& out) const {
  if (!last_ || kind_ == CanOdometryKind::speeds) return false;
  out.origin = origin_;
  out.at = stamp_at(last_->at, epoch_minus_monotonic_);
  out.T_odom_body = T_odom_body_;
  out.numbers = {};
  out.numbers[kSignature] = signature();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto channel = channels_[i].memory();
    if (!channel) return false;
    out.numbers[kOfChannel * i] = channel->value.raw;
    out.put(kOfChannel * i + 1, channel->value.value);
    out.put(kOfChannel * i + 2, in_seconds(channel->at - last_->at));
    out.put(kOfChannel * i + 3, channel->quantity);
    out.put(kLast + i, last_->values.at(i));
  }
  return true;
}

bool CanOdometer::restore(const OdometerMemory& memory) {
  if (kind_ == CanOdometryKind::speeds || memory.numbers[kSignature] != signature()) return false;
  if (!is_sane(memory)) return false;
  const DeviceClock::time_point at = instant_of(memory.at, epoch_minus_monotonic_);
  last_ = Instant{at, {}};
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const std::size_t first = kOfChannel * i;
    channels_[i].restore({.value = {.raw = memory.numbers.at(first), .value = memory.real(first + 1)},
                          .at = at + clock_duration(memory.real(first + 2)),
                          .quantity = memory.real(first + 3)});
    last_->values.at(i) = memory.real(kLast + i);
  }
  heard_at_ = at;
  T_odom_body_ = memory.T_odom_body;
  origin_ = first_origin_ = memory.origin;
  return true;
}

}  // namespace azimuth
