// Readings of a base that falls silent, restarts, or sends impossible values.

#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <rapidcheck/gtest.h>

#include "drivers/can/can_odometer.hpp"
#include "tests/drivers/can/can_odometer_bench.hpp"
#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::expect_orderly;
using test::OdometerBench;

TEST(CanOdometer, LostFramesLoseNoMotion) {
  OdometerBench bench(test::ticks_layout());
  bench.send();
  bench.run(0.5, 0.55, 1s);
  bench.go(0.5, 0.55, 300ms);
  bench.send();
  bench.run(0.5, 0.55, 1s);
  EXPECT_LT(bench.distance_from_truth_m(), 0.001);
  EXPECT_GT(bench.odometer.missed(), 10U);
  EXPECT_EQ(bench.odometer.restarts(), 0U);
  EXPECT_GT(bench.odometer.gaps(), 0U) << "where on the way it turned is not known";
}

TEST(CanOdometer, ALongSilenceIsUncertainAndKeepsTheOrigin) {
  OdometerBench bench(test::ticks_layout());
  bench.run(0.5, 0.5, 1s);
  const std::size_t before = bench.readings.size();
  bench.go(0.5, 0.5, 5s);
  bench.send();
  bench.run(0.0, 0.0, 100ms);
  EXPECT_EQ(bench.readings.back().origin, bench.readings.front().origin);
  EXPECT_NEAR(bench.pose().x_m, bench.base.pose().x_m, 0.012);
  double sigma_m = 0.0, sigma_rad = 0.0;
  for (std::size_t i = before; i < bench.readings.size(); ++i) {
    sigma_m = std::max(sigma_m, bench.readings[i].sigma_gap_m);
    sigma_rad = std::max(sigma_rad, bench.readings[i].sigma_gap_rad);
  }
  EXPECT_GT(sigma_m, 0.3);
  EXPECT_GT(sigma_rad, 0.2);
}

TEST(CanOdometer, ABaseThatRestartsGetsANewOrigin) {
  for (const auto& layout : {test::ticks_layout(), test::ticks_layout(test::kLeftId)}) {
    OdometerBench bench(layout);
    bench.run(0.5, 0.6, 3s);
    const OdometryReading before = bench.readings.back();
    bench.base.restart();
    bench.run(0.5, 0.6, 1s);
    EXPECT_EQ(bench.odometer.restarts(), 1U);
    EXPECT_EQ(bench.readings.back().origin, before.origin + 1);
    EXPECT_LT(bench.pose().position().norm(), 0.56) << "of the new origin";
    EXPECT_GT(bench.pose().position().norm(), 0.45);
    const auto first = std::ranges::find(bench.readings, before.origin + 1, &OdometryReading::origin);
    EXPECT_GT(first->sigma_gap_m, 0.05);
    EXPECT_EQ(first->T_odom_body, Pose2{});
    EXPECT_EQ(bench.readings.back().sigma_gap_m, 0.0);
    expect_orderly(bench.readings);
  }
}

TEST(CanOdometer, ABaseThatWasSwitchedOffNearItsZeroGetsANewOriginToo) {
  OdometerBench bench(test::ticks_layout());
  bench.run(0.5, 0.5, 1s);
  bench.now += 3s;
  bench.base.restart();
  bench.run(0.0, 0.0, 1s);
  EXPECT_EQ(bench.odometer.restarts(), 1U) << "half a metre back in three seconds is possible, and not what happened";
}

TEST(CanOdometer, OneWildValueIsNotBelieved) {
  OdometerBench bench(test::ticks_layout());
  bench.send();
  bench.run(0.5, 0.5, 1s);
  CanFrame wild = bench.base.frames(bench.layout)[0];
  wild.data[3] ^= 0x40;
  bench.add(wild, bench.now + 1ms);
  bench.run(0.5, 0.5, 1s);
  EXPECT_LT(bench.distance_from_truth_m(), 0.001);
  EXPECT_EQ(bench.odometer.restarts(), 0U);
  EXPECT_EQ(bench.odometer.doubted(), 1U);
}

TEST(CanOdometer, SpeedsOverAGapAreUncertain) {
  OdometerBench bench(test::speeds_layout());
  bench.run(0.5, 0.5, 1s);
  bench.go(0.5, 0.5, 200ms);
  bench.send();
  EXPECT_NEAR(bench.pose().x_m, bench.base.pose().x_m, 0.011);
  EXPECT_GT(bench.readings.back().sigma_gap_m, 0.001);
  EXPECT_GT(bench.readings.back().sigma_gap_rad, 0.005);
  bench.run(0.5, 0.5, 100ms);
  EXPECT_EQ(bench.readings.back().sigma_gap_m, 0.0);
  EXPECT_EQ(bench.odometer.restarts(), 0U);
}

TEST(CanOdometer, SpeedsAfterALongSilenceHaveANewOrigin) {
  OdometerBench bench(test::speeds_layout());
  bench.run(0.5, 0.5, 1s);
  bench.go(0.5, 0.5, 2s);
  bench.run(0.5, 0.5, 100ms);
  EXPECT_EQ(bench.odometer.restarts(), 1U);
  EXPECT_GT(bench.odometer.gaps(), 0U);
}

TEST(CanOdometer, ForeignAndShortFramesChangeNothing) {
  OdometerBench with(test::ticks_layout()), without(test::ticks_layout());
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    for (OdometerBench* const bench : {&with, &without}) {
      bench->go(0.4, 0.5);
      if (bench == &with) {
        for (std::uint8_t size = 0; size < 4; ++size) {
          CanFrame frame = test::empty_frame(size % 2 == 0 ? test::kLeftId : test::kRightId);
          frame.size = size;
          with.add(frame, with.now);
          frame.size = 8;
          frame.id.number = 0x300 + random() % 256;
          with.add(frame, with.now);
          frame.id = test::kLeftId;
          frame.kind = CanFrame::Kind::remote;
          with.add(frame, with.now);
        }
      }
      bench->send();
    }
  }
  EXPECT_EQ(with.readings, without.readings);
  EXPECT_EQ(with.odometer.malformed(), 400U);
}

TEST(CanOdometer, FloatsThatAreNoNumbersAreMalformed) {
  CanLayout layout = test::speeds_layout();
  for (std::size_t i = 0; i < 2; ++i)
    layout.motion[i].signal = {
        test::kLeftId, {32 * static_cast<int>(i), 32, CanByteOrder::intel}, CanNumber::ieee_float};
  OdometerBench bench(layout);
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 1e30}) {
    bench.run(0.5, 0.5, 100ms);
    CanFrame frame = test::empty_frame(test::kLeftId);
    encode(layout.motion[0].signal, wrong, frame);
    bench.add(frame, bench.now);
    for (const OdometryReading& reading : bench.readings) ASSERT_TRUE(std::isfinite(reading.T_odom_body.x_m));
  }
  EXPECT_EQ(bench.odometer.malformed(), 3U);
}

TEST(CanOdometer, StampsThatGoBackOrStandStillStillGiveIncreasingOnes) {
  OdometerBench bench(test::ticks_layout(test::kLeftId));
  bench.send();
  bench.run(0.5, 0.5, 1s);
  for (int i = 0; i < 50; ++i) {
    bench.base.drive(0.5, 0.5, 0.001);
    bench.add(bench.base.frames(bench.layout)[0], bench.now - 1s + 5ms * i);
  }
  bench.run(0.5, 0.5, 1s);
  expect_orderly(bench.readings);
  EXPECT_LT(bench.distance_from_truth_m(), 0.001);
}

RC_GTEST_PROP(CanOdometer, NothingThatABaseSendsMakesAReadingThatIsNotFinite, ()) {
  const auto kind = *rc::gen::inRange(0, 3);
  OdometerBench bench(kind == 0 ? test::ticks_layout() : kind == 1 ? test::speeds_layout() : test::pose_layout());
  const auto ids = std::array{test::kLeftId, test::kRightId, test::kPoseId};
  const auto count = *rc::gen::inRange(0, 200);
  for (int i = 0; i < count; ++i) {
    bench.now += std::chrono::microseconds(*rc::gen::inRange(0, 3'000'000));
    CanFrame frame = test::empty_frame(ids.at(*rc::gen::inRange<std::size_t>(0, 3)));
    frame.size = *rc::gen::inRange<std::uint8_t>(0, 9);
    for (std::size_t byte = 0; byte < frame.size; ++byte) frame.data.at(byte) = *rc::gen::arbitrary<std::uint8_t>();
    bench.add(frame, bench.now);
  }
  for (std::size_t i = 0; i < bench.readings.size(); ++i) {
    const OdometryReading& reading = bench.readings[i];
    RC_ASSERT(std::isfinite(reading.T_odom_body.x_m) && std::isfinite(reading.T_odom_body.y_m));
    RC_ASSERT(reading.T_odom_body.heading_rad >= -kPi && reading.T_odom_body.heading_rad < kPi);
    RC_ASSERT(std::isfinite(reading.sigma_gap_m) && reading.sigma_gap_m >= 0.0);
    RC_ASSERT(std::isfinite(reading.sigma_gap_rad) && reading.sigma_gap_rad >= 0.0);
    if (i > 0) RC_ASSERT(reading.stamp > bench.readings[i - 1].stamp);
  }
}

}  // namespace
}  // namespace azimuth
