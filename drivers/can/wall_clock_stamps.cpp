#include "drivers/can/wall_clock_stamps.hpp"

#include <algorithm>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kStep = 100us;  // a change larger than this is a step, not a slow correction of the clock
constexpr auto kSlack = 2ms;   // the two clocks are not read at the same instant

}  // namespace

void WallClockStamps::look(Wall wall_now, DeviceClock::time_point now) {
  const std::chrono::nanoseconds difference = now.time_since_epoch() - wall_now;
  const bool first = now_ == DeviceClock::time_point{};
  if (first || difference - monotonic_minus_wall_ > kStep || monotonic_minus_wall_ - difference > kStep)
    before_ = first ? difference : monotonic_minus_wall_;
  monotonic_minus_wall_ = difference;
  now_ = now;
}

bool WallClockStamps::can_be(DeviceClock::time_point at) const {
  return at >= empty_at_ - kSlack && at <= now_ + kSlack;
}

DeviceClock::time_point WallClockStamps::monotonic(Wall stamp) {
  const DeviceClock::time_point at(stamp + monotonic_minus_wall_), at_before(stamp + before_);
  if (can_be(at)) return std::min(at, now_);
  if (can_be(at_before)) return std::min(at_before, now_);
  ++replaced_;
  return now_;
}

}  // namespace azimuth
