#include "daemon/record/event_times.hpp"

#include <algorithm>

#include "base/clocks.hpp"

namespace azimuth {

EventTimes EventTimes::live(Duration epoch_minus_monotonic) {
  return {epoch_minus_monotonic, (now_on(CLOCK_MONOTONIC) + epoch_minus_monotonic).count()};
}

EventTimes EventTimes::of_recording(Stamp first) {
  const Duration begins = now_on(CLOCK_REALTIME);
  EventTimes times(std::nullopt, begins.count());
  times.ahead_ = begins - first.time_since_epoch();
  return times;
}

std::int64_t EventTimes::of_sample(Stamp stamp) {
  if (epoch_minus_monotonic_) return now();
  reached_us_ = std::max(reached_us_, to_us(stamp + ahead_));
  return next();
}

std::int64_t EventTimes::now() {
  if (epoch_minus_monotonic_) reached_us_ = (now_on(CLOCK_MONOTONIC) + *epoch_minus_monotonic_).count();
  return next();
}

std::int64_t EventTimes::next() { return last_us_ = std::max(last_us_ + kLeast_us, reached_us_); }

}  // namespace azimuth
