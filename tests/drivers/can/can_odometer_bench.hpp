#pragma once
// The CAN odometer on a base that drives.

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

#include "drivers/can/can_odometer.hpp"
#include "tests/drivers/can/fake_base.hpp"

namespace azimuth::test {

using namespace std::chrono_literals;

inline constexpr Duration kEpochMinusMonotonic = 1'000'000s;
inline constexpr auto kCycle = 20ms;

/// A base, an odometer, and the odometer's readings.
class OdometerBench {
 public:
  explicit OdometerBench(const CanLayout& of_base, const CanSettings& settings = {})
      : layout(of_base), odometer(of_base, settings, kEpochMinusMonotonic) {}

  CanLayout layout;
  CanOdometer odometer;
  FakeBase base;
  DeviceClock::time_point now{1h};
  DeviceClock::duration second_frame_later = 100us;
  std::vector<OdometryReading> readings;

  void add(const CanFrame& frame, DeviceClock::time_point at) {
    if (const auto reading = odometer.add(frame, at)) readings.push_back(*reading);
  }
  void send() {
    auto at = now;
    for (const CanFrame& frame : base.frames(layout)) {
      add(frame, at);
      at += second_frame_later;
    }
  }
  void run(double left_m_s, double right_m_s, DeviceClock::duration time) {
    for (const auto end = now + time; now < end;) {
      go(left_m_s, right_m_s);
      send();
    }
  }
  /// The base drives without sending frames.
  void go(double left_m_s, double right_m_s, DeviceClock::duration time = kCycle) {
    now += time;
    base.drive(left_m_s, right_m_s, in_seconds(time));
  }
  const Pose2& pose() const { return readings.back().T_odom_body; }
  double distance_from_truth_m() const { return (pose().position() - base.pose().position()).norm(); }
};

inline void drive_a_course(OdometerBench& bench) {
  bench.send();
  bench.run(0.5, 0.5, 2s);
  bench.run(0.5, 0.8, 2s);
  bench.run(-0.2, 0.2, 3s);
  bench.run(-0.5, -0.45, 4s);
  bench.run(0.0, 0.0, 100ms);
}

inline void expect_orderly(const std::vector<OdometryReading>& readings) {
  for (std::size_t i = 1; i < readings.size(); ++i) {
    EXPECT_GT(readings[i].stamp, readings[i - 1].stamp);
    EXPECT_EQ(readings[i].sequence, readings[i - 1].sequence + 1);
  }
}

}  // namespace azimuth::test
