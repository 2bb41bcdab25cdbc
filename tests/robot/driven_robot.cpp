#include "tests/robot/driven_robot.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

#include "sim/pioneer/fault_schedule.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using Clock = PioneerDriver::Clock;

/// The driver's clock differs from the stamps, as CLOCK_MONOTONIC differs from the time of day.
constexpr Duration kMonotonicAtStart = 1h;

Clock::time_point driver_time(Stamp now) { return Clock::time_point(now.time_since_epoch() + kMonotonicAtStart); }

}  // namespace

DrivenRobot::DrivenRobot(const RobotSetup& setup, sim::Chassis& chassis)
    : wheels_(chassis, setup.model.track_mm / 1000.0),
      pioneer_(setup.model, wheels_, setup.seed),
      adapter_(pioneer_, setup.adapter, setup.seed),
      driver_(setup.settings, -kMonotonicAtStart, adapter_.opener()) {}

DrivenRobot::~DrivenRobot() { driver_.close(Clock::time_point{}); }

void DrivenRobot::fault(std::string_view text) {
  const auto parsed = sim::parse_fault(text);
  ASSERT_TRUE(parsed) << text << ": " << parsed.error();
  parsed->apply(pioneer_);
}

void DrivenRobot::run_until(Stamp end) {
  while (true) {
    const Stamp next = std::min({pioneer_.due(), adapter_.due(), driver_due_});
    if (next > end) break;
    step(std::max(next, now_));
  }
  step(end);
}

bool DrivenRobot::run_to_reading(Duration at_most) {
  const std::size_t before = sightings.size();
  for (const Stamp end = now_ + at_most; now_ < end && sightings.size() == before;) run(1ms);
  return sightings.size() > before;
}

void DrivenRobot::step(Stamp now) {
  now_ = now;
  pioneer_.advance(now);
  note_latches();
  adapter_.advance(now);
  if (adapter_.due() <= now || driver_due_ <= now) turn_driver();
}

void DrivenRobot::turn_driver() {
  ++turns;
  const bool ran = state().connection == Connection::running;
  const std::size_t before = allocations();
  driver_.turn(driver_time(now_));
  if (ran && state().connection == Connection::running) allocations_while_running += allocations() - before;
  adapter_.send_written();
  for (OdometryReading reading; driver_.take(reading);) note(reading);
  for (std::string event; driver_.take_event(event);) events.push_back(event);
  const auto due_in = driver_.due_in(driver_time(now_));
  EXPECT_GE(due_in.count(), 0);
  driver_due_ = now_ + std::max(Duration{1}, std::chrono::ceil<Duration>(due_in));
}

void DrivenRobot::note_latches() {
  constexpr std::size_t kKept = 64;
  for (const sim::SipLatch& latch : pioneer_.take_latches()) {
    EXPECT_EQ(to_us(latch.stamp), to_us(wheels_.rolled_to()));
    latches_.push_back({latch.stamp, wheels_.T_odom_body(), wheels_.path_m()});
    if (latches_.size() > kKept) latches_.pop_front();
  }
}

/// The nearest latch is unique, because cycles are much farther apart than the error of any stamp.
const DrivenRobot::Latch& DrivenRobot::latch_nearest(Stamp stamp) const {
  return *std::ranges::min_element(latches_, {},
                                   [stamp](const Latch& latch) { return std::abs((latch.at - stamp).count()); });
}

void DrivenRobot::note(const OdometryReading& reading) {
  ASSERT_FALSE(latches_.empty()) << "a reading of nothing";
  const Latch& latch = latch_nearest(reading.stamp);
  sightings.push_back({reading, now_, latch.at, latch.T_odom_wheels, latch.path_m});
  on_sighting(sightings.back());
}

}  // namespace azimuth::test
