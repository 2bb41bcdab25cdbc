#include "drivers/iidc/iidc_stamps.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth::iidc {
namespace {

constexpr std::int64_t kOldest_us = 10'000'000;
/// Tolerance for the difference of the clocks between two readings without a step: the reading takes time, and the wall
/// clock is slewed by up to 500 ppm.
constexpr std::int64_t kReadingError_us = 2000;
constexpr std::int64_t kSlewDivisor = 1000;

constexpr double kSameInterval = 0.1;
constexpr double kPlainlyWrong = 0.05;
constexpr int kLongRow = 64;
constexpr double kFollowing = 0.125;

}  // namespace

void StampClock::watch_for_step(const ClockReading& now) {
  const std::int64_t passed_us = now.monotonic_us - last_.monotonic_us;
  const std::int64_t parted_us = (now.wall_us - last_.wall_us) - passed_us;
  if (std::abs(parted_us) > kReadingError_us + passed_us / kSlewDivisor) stepped_ = true;
  last_ = now;
}

Stamp StampClock::monotonic(std::uint64_t wall_us, const ClockReading& now) {
  watch_for_step(now);
  const std::uint64_t age_us = static_cast<std::uint64_t>(now.wall_us) - wall_us;  // huge if negative
  const bool believed = !stepped_ && age_us <= static_cast<std::uint64_t>(kOldest_us);
  return stamp_from_us(now.monotonic_us - (believed ? static_cast<std::int64_t>(age_us) : 0));
}

void StampClock::drained(const ClockReading& now) {
  watch_for_step(now);
  stepped_ = false;
}

/// The mean over a steady series is as accurate as the series is long, so a short series corrects only
/// large errors.
void FrameCounter::learn(double before_us, double now_us) {
  const double row_us = before_us - steady_since_us_;
  const bool steady =
      steady_frames_ > 0 && std::abs((now_us - before_us) * steady_frames_ - row_us) <= kSameInterval * row_us;
  if (!steady || steady_frames_ >= kLongRow) {
    steady_since_us_ = before_us;
    steady_frames_ = 0;
  }
  const double mean_us = (now_us - steady_since_us_) / ++steady_frames_;
  const bool plainly_wrong = std::abs(mean_us - interval_us_) > kPlainlyWrong * interval_us_;
  if (mean_us > 0 && (steady_frames_ >= kLongRow || (steady_frames_ >= kSteady && plainly_wrong)))
    interval_us_ = mean_us;
}

std::uint64_t FrameCounter::next(Stamp stamp) {
  const auto now_us = static_cast<double>(to_us(stamp));
  const std::optional<Stamp> before = last_;
  last_ = stamp;
  if (!before) {
    expected_us_ = now_us;
    return sequence_;
  }
  learn(static_cast<double>(to_us(*before)), now_us);
  const double intervals = interval_us_ > 0 ? std::round((now_us - expected_us_) / interval_us_) : 1.0;
  const double counted = std::max(intervals, 1.0);
  sequence_ += static_cast<std::uint64_t>(counted);
  // The expectation follows the frames slowly, so that a late frame does not make the next one appear early.
  expected_us_ += counted * interval_us_;
  const double late_us = now_us - expected_us_;
  expected_us_ += std::abs(late_us) < interval_us_ / 2 ? kFollowing * late_us : late_us;
  return sequence_;
}

}  // namespace azimuth::iidc
