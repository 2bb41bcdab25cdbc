// Readings of a base that drives a known path.

#include "drivers/can/can_odometer.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/can/can_odometer_bench.hpp"
#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::drive_a_course;
using test::expect_orderly;
using test::kCycle;
using test::kEpochMinusMonotonic;
using test::OdometerBench;

TEST(CanOdometer, TicksInOneFrameTellTheWay) {
  OdometerBench bench(test::ticks_layout(test::kLeftId));
  drive_a_course(bench);
  EXPECT_EQ(bench.readings.size(), 556U);
  EXPECT_LT(bench.distance_from_truth_m(), 0.002);
  EXPECT_NEAR(bench.pose().heading_rad, bench.base.pose().heading_rad, 0.001);
  EXPECT_EQ(to_us(bench.readings.back().stamp), to_us(Stamp{1h + 11100ms + kEpochMinusMonotonic}));
  EXPECT_EQ(bench.odometer.gaps(), 0U);
  EXPECT_EQ(bench.odometer.missed(), 0U);
  EXPECT_EQ(bench.readings.front().origin, bench.readings.back().origin);
  expect_orderly(bench.readings);
}

TEST(CanOdometer, TicksInTwoFramesGiveAReadingWhenBothAreThere) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  EXPECT_LT(bench.distance_from_truth_m(), 0.002);
  EXPECT_GE(bench.readings.size(), 555U);
  EXPECT_LE(bench.readings.size(), 557U);
  EXPECT_EQ(bench.readings.back().stamp.time_since_epoch(), bench.now.time_since_epoch() + kEpochMinusMonotonic);
  expect_orderly(bench.readings);
}

TEST(CanOdometer, StaggeredFramesGiveNoFalseTurn) {
  OdometerBench bench(test::ticks_layout());
  bench.second_frame_later = 0ms;
  for (int i = 0; i < 200; ++i) {  // left and right alternate every 10 ms, straight ahead at 1 m/s
    bench.go(1.0, 1.0, 10ms);
    bench.add(bench.base.frames(bench.layout)[static_cast<std::size_t>(i % 2)], bench.now);
  }
  EXPECT_NEAR(bench.pose().x_m, 1.97, 0.03);
  for (const OdometryReading& reading : bench.readings) EXPECT_NEAR(reading.T_odom_body.heading_rad, 0.0, 0.001);
}

TEST(CanOdometer, ALostFrameOfOneWheelLeavesNoShift) {
  OdometerBench bench(test::ticks_layout());
  bench.send();
  bench.run(1.0, 1.0, 1s);
  bench.go(1.0, 1.0);
  bench.add(bench.base.frames(bench.layout)[1], bench.now);  // the left frame is lost
  bench.run(1.0, 1.0, 1s);
  for (const OdometryReading& reading : bench.readings) EXPECT_NEAR(reading.T_odom_body.heading_rad, 0.0, 0.002);
  EXPECT_LT(bench.distance_from_truth_m(), 0.001);
}

TEST(CanOdometer, NarrowCountersWrapAgainAndAgain) {
  for (const int length_bits : {12, 13, 16, 24, 32}) {
    OdometerBench bench(test::ticks_layout(test::kLeftId, length_bits));
    bench.base.set_counters(-0.1, 0.02);
    drive_a_course(bench);
    EXPECT_LT(bench.distance_from_truth_m(), 0.002) << length_bits;
    EXPECT_EQ(bench.odometer.restarts(), 0U) << length_bits;
  }
}

TEST(CanOdometer, SpeedsAreIntegratedByTheirStamps) {
  OdometerBench bench(test::speeds_layout());
  drive_a_course(bench);
  // After a sudden change of speed the trapezoidal rule is wrong by half a cycle.
  EXPECT_LT(bench.distance_from_truth_m(), 0.05);
  EXPECT_NEAR(bench.pose().heading_rad, bench.base.pose().heading_rad, 0.05);
  EXPECT_EQ(bench.odometer.gaps(), 0U);
}

TEST(CanOdometer, PosesOfTheBaseAreFollowedFromTheFirst) {
  OdometerBench bench(test::pose_layout());
  bench.base.drive(0.3, 0.5, 2.0);  // before the odometer listens, so that the heading is not 0
  const Pose2 start = bench.base.pose();
  drive_a_course(bench);
  const Pose2 truth = inverse(start) * bench.base.pose();
  EXPECT_NEAR(bench.pose().x_m, truth.x_m, 0.002);
  EXPECT_NEAR(bench.pose().y_m, truth.y_m, 0.002);
  EXPECT_NEAR(wrap(bench.pose().heading_rad - truth.heading_rad), 0.0, 0.001);
  EXPECT_EQ(bench.odometer.restarts(), 0U);
  EXPECT_EQ(bench.odometer.doubted(), 0U) << "the heading passed from 360 to 0 degrees";
}

TEST(CanOdometer, HeadingsMayWrapAtTheirBits) {
  CanLayout layout = test::pose_layout();
  // 10 bits of 0.01 rad: the counter wraps at 10.24 rad, not at a full turn.
  layout.motion[2] = {{test::kPoseId, {32, 10, CanByteOrder::intel}, CanNumber::unsigned_integer, 0.01}, 1.0, 6.3};
  OdometerBench bench(layout);
  for (int i = 0; i < 2000; ++i) {
    bench.now += kCycle;
    CanFrame frame = test::empty_frame(test::kPoseId);
    write_bits(layout.motion[2].signal.bits, static_cast<std::uint64_t>(2 * i) % 1024, {frame.data.data(), 8});
    bench.add(frame, bench.now);
    ASSERT_NEAR(wrap(bench.pose().heading_rad - 0.02 * i), 0.0, 1e-6) << i;
  }
}

TEST(CanOdometer, ReadingsAreAtMost500ASecond) {
  OdometerBench bench(test::ticks_layout(test::kLeftId));
  bench.send();
  for (int i = 0; i < 10'000; ++i) {
    bench.go(0.5, 0.5, 100us);
    bench.send();
  }
  EXPECT_LE(bench.readings.size(), 502U);
  EXPECT_NEAR(bench.pose().x_m, 0.5, 0.002);
}

TEST(CanOdometer, NeverAllocates) {
  OdometerBench bench(test::ticks_layout());
  bench.run(0.5, 0.5, 1s);
  const std::vector<CanFrame> frames = bench.base.frames(bench.layout);
  const std::size_t before = allocations();
  for (int i = 0; i < 1000; ++i) {
    bench.now += 10ms;
    bench.odometer.add(frames[0], bench.now);
    bench.odometer.add(frames[1], bench.now + 100us);
  }
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
