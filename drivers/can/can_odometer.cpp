#include "drivers/can/can_odometer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

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

constexpr DeviceClock::duration kLeastInterval = std::chrono::milliseconds(2);
constexpr double kHiddenPath = 0.05;  // standard deviation per metre of a path between two distant instants
// Standard deviation per radian when values are missing, because the place of the turn on the path is unknown.
constexpr double kHiddenArc = 0.25;

// While the base is silent the robot may continue to drive, start to turn, or be pushed.
constexpr double kLongestDrive_s = 5.0;
constexpr double kIndoorTurn_rad_s = 1.0;  // robots indoors turn by up to this rate
constexpr double kMayTurn_rad_s = 0.45;    // standard deviation of the turn rate
constexpr double kPushed_m = 0.05, kPushed_rad = 0.05;

CanQuantity quantity_of(CanOdometryKind kind, std::size_t channel) {
  if (kind == CanOdometryKind::speeds) return CanQuantity::speed;
  return kind == CanOdometryKind::pose && channel == 2 ? CanQuantity::heading : CanQuantity::way;
}

}  // namespace

CanOdometer::CanOdometer(const CanLayout& layout, const CanSettings& settings, Duration epoch_minus_monotonic)
    : kind_(layout.odometry),
      track_m_(layout.track_m),
      max_speed_m_s_(settings.max_speed_m_s),
      stale_s_(settings.stale_s),
      latency_(clock_duration(settings.latency_s)),
      epoch_minus_monotonic_(epoch_minus_monotonic) {
  assert(layout.motion.size() == (kind_ == CanOdometryKind::pose ? 3U : 2U));
  for (const CanMotionSignal& motion : layout.motion)
    channels_.emplace_back(motion, quantity_of(kind_, channels_.size()), stale_s_);
}

std::optional<OdometryReading> CanOdometer::add(const CanFrame& frame, DeviceClock::time_point at) {
  heard_at_ = std::max(heard_at_, at);
  const Heard heard = hear(frame, heard_at_);
  if (!heard.any) return std::nullopt;
  if (heard.restarted) begin_anew(heard, heard_at_);
  const auto now = newest_instant();
  if (!now || (last_ && now->at < last_->at + kLeastInterval)) return std::nullopt;
  const auto before = std::exchange(last_, now);
  if (!before) {
    bridge_outage(now->at);
    return reading(now->at);
  }
  const Pose2 T_last_body = step(before->values, now->values);
  const double elapsed_s = in_seconds(now->at - before->at);
  T_odom_body_ = T_odom_body_ * T_last_body;
  step_sigma(T_last_body, elapsed_s);
  speed_m_s_ = T_last_body.position().norm() / elapsed_s;
  turn_rad_s_ = T_last_body.heading_rad / elapsed_s;
  return reading(now->at);
}

CanOdometer::Heard CanOdometer::hear(const CanFrame& frame, DeviceClock::time_point at) {
  Heard heard;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const CanDecoded decoded = decode(channels_[i].signal(), frame);
    if (decoded.found == CanFound::elsewhere) continue;
    if (decoded.found != CanFound::value || !channels_[i].is_sane(decoded.value)) {
      ++malformed_;
      continue;
    }
    const CanChannel::Taken taken = channels_[i].add(decoded.value, at);
    if (taken == CanChannel::Taken::doubted) continue;
    heard.values.at(i) = decoded.value;
    heard.any = true;
    heard.restarted = heard.restarted || taken == CanChannel::Taken::restarted;
  }
  return heard;
}

/// One counter that restarts means that all have restarted. The values in this frame are already the new ones.
void CanOdometer::begin_anew(const Heard& heard, DeviceClock::time_point at) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (const auto& value = heard.values.at(i)) {
      channels_[i].begin(*value, at);
    } else {
      channels_[i].forget();
    }
  }
  if (last_) before_restart_ = last_->at;
  last_.reset();
  ++origin_;
  T_odom_body_ = {};
  sigma_m_ = sigma_rad_ = 0.0;
}

/// The newest instant at which every channel is known.
std::optional<CanOdometer::Instant> CanOdometer::newest_instant() const {
  Instant instant{DeviceClock::time_point::max(), {}};
  for (const CanChannel& channel : channels_) {
    const auto newest_at = channel.newest_at();
    if (!newest_at) return std::nullopt;
    instant.at = std::min(instant.at, *newest_at);
  }
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto value = channels_[i].at(instant.at);
    if (!value) return std::nullopt;
    instant.values.at(i) = *value;
  }
  return instant;
}

/// The motion T_from_to of the body.
Pose2 CanOdometer::step(const Values& from, const Values& to) const {
  if (kind_ == CanOdometryKind::pose) {
    const Pose2 T_base_from{from[0], from[1], wrap(from[2])}, T_base_to{to[0], to[1], wrap(to[2])};
    return inverse(T_base_from) * T_base_to;
  }
  const double left_m = to[0] - from[0], right_m = to[1] - from[1];
  const double turn_rad = (right_m - left_m) / track_m_, half_rad = 0.5 * turn_rad;
  // Ratio of chord to arc.
  const double chord = half_rad == 0.0 ? 1.0 : std::sin(half_rad) / half_rad;
  const double length_m = 0.5 * (left_m + right_m) * chord;
  return {length_m * std::cos(half_rad), length_m * std::sin(half_rad), wrap(turn_rad)};
}

/// Adds the uncertainty of a step: the uncertainty of the channels, and that of the path's shape over a gap.
void CanOdometer::step_sigma(const Pose2& T_last_body, double elapsed_s) {
  Values sigmas{};
  for (std::size_t i = 0; i < channels_.size(); ++i) sigmas.at(i) = channels_[i].take_sigma();
  if (kind_ == CanOdometryKind::pose) {
    add_sigma(std::hypot(sigmas[0], sigmas[1]), sigmas[2]);
  } else {
    const double both_m = std::hypot(sigmas[0], sigmas[1]);
    add_sigma(0.5 * both_m, both_m / track_m_);
  }
  const std::uint64_t missed_before = std::exchange(missed_at_last_, missed());
  const bool is_outage = elapsed_s > stale_s_;
  if (missed_before != missed_at_last_ || is_outage)
    add_sigma(kHiddenArc * T_last_body.position().norm() * std::abs(T_last_body.heading_rad), 0.0);
  if (is_outage) {
    const double turning_rad_s = std::max(kIndoorTurn_rad_s, std::abs(turn_rad_s_));
    add_sigma(kHiddenPath * max_speed_m_s_ * elapsed_s, kHiddenPath * turning_rad_s * elapsed_s);
  }
}

void CanOdometer::add_sigma(double sigma_m, double sigma_rad) {
  sigma_m_ = std::hypot(sigma_m_, sigma_m);
  sigma_rad_ = std::min(kPi, std::hypot(sigma_rad_, sigma_rad));
}

void CanOdometer::bridge_outage(DeviceClock::time_point at) {
  if (!before_restart_) return;
  const double drive_s = std::min(kLongestDrive_s, std::max(0.0, in_seconds(at - *before_restart_)));
  const double turning_rad_s = std::max(kMayTurn_rad_s, std::abs(turn_rad_s_));
  add_sigma(kPushed_m + speed_m_s_ * drive_s, kPushed_rad + turning_rad_s * drive_s);
  before_restart_.reset();
}

OdometryReading CanOdometer::reading(DeviceClock::time_point at) {
  OdometryReading reading = order_.next(stamp_at(at - latency_, epoch_minus_monotonic_));
  reading.origin = origin_;
  reading.T_odom_body = T_odom_body_;
  reading.sigma_gap_m = std::exchange(sigma_m_, 0.0);
  reading.sigma_gap_rad = std::exchange(sigma_rad_, 0.0);
  if (reading.sigma_gap_m > 0.0 || reading.sigma_gap_rad > 0.0) ++gaps_;
  return reading;
}

std::uint64_t CanOdometer::missed() const {
  std::uint64_t missed = 0;
  for (const CanChannel& channel : channels_) missed += channel.missed();
  return missed;
}

std::uint64_t CanOdometer::doubted() const {
  std::uint64_t doubted = 0;
  for (const CanChannel& channel : channels_) doubted += channel.doubted();
  return doubted;
}

// The state that outlives the process.

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
