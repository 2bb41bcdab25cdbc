// Readings of a base that drives a known path, and of one that does what it should not.

#include "drivers/can/can_odometer.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <random>
#include <rapidcheck/gtest.h>

#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::FakeBase;

constexpr Duration kEpochMinusMonotonic = 1'000'000s;
constexpr auto kCycle = 20ms;

/// A base, an odometer, and what came of the two.
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
  /// Unheard.
  void go(double left_m_s, double right_m_s, DeviceClock::duration time = kCycle) {
    now += time;
    base.drive(left_m_s, right_m_s, in_seconds(time));
  }
  const Pose2& pose() const { return readings.back().T_odom_body; }
  double distance_from_truth_m() const { return (pose().position() - base.pose().position()).norm(); }
};

void drive_a_course(OdometerBench& bench) {
  bench.send();
  bench.run(0.5, 0.5, 2s);
  bench.run(0.5, 0.8, 2s);
  bench.run(-0.2, 0.2, 3s);
  bench.run(-0.5, -0.45, 4s);
  bench.run(0.0, 0.0, 100ms);
}

void expect_orderly(const std::vector<OdometryReading>& readings) {
  for (std::size_t i = 1; i < readings.size(); ++i) {
    EXPECT_GT(readings[i].stamp, readings[i - 1].stamp);
    EXPECT_EQ(readings[i].sequence, readings[i - 1].sequence + 1);
  }
}

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
  for (int i = 0; i < 200; ++i) {  // left and right in turns, 10 ms apart, at 1 m/s straight on
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
  bench.add(bench.base.frames(bench.layout)[1], bench.now);  // the left one is lost
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

TEST(CanOdometer, SpeedsAreIntegratedByTheirStamps) {
  OdometerBench bench(test::speeds_layout());
  drive_a_course(bench);
  // Where the speed changes at once, the trapezium is off by half a cycle.
  EXPECT_LT(bench.distance_from_truth_m(), 0.05);
  EXPECT_NEAR(bench.pose().heading_rad, bench.base.pose().heading_rad, 0.05);
  EXPECT_EQ(bench.odometer.gaps(), 0U);
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

TEST(CanOdometer, PosesOfTheBaseAreFollowedFromTheFirst) {
  OdometerBench bench(test::pose_layout());
  bench.base.drive(0.3, 0.5, 2.0);  // before we listen: its heading is not 0
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
  // 10 bits of 0.01 rad: the counter wraps at 10.24 rad, not at a turn.
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

/// The process after that of `before`: as far as it knows, at the same base.
std::unique_ptr<OdometerBench> next_process(const OdometerBench& before, const CanLayout& layout) {
  auto next = std::make_unique<OdometerBench>(layout);
  OdometerMemory memory;
  EXPECT_TRUE(before.odometer.remember(memory));
  if (!next->odometer.restore(memory)) next->odometer.follow(memory.origin);
  next->base = before.base;
  next->now = before.now;
  return next;
}

TEST(CanOdometerMemory, LetsTheNextProcessGoOnAndLosesNoMotion) {
  for (const auto& layout : {test::ticks_layout(), test::ticks_layout(test::kLeftId), test::pose_layout()}) {
    OdometerBench bench(layout);
    drive_a_course(bench);
    const auto next = next_process(bench, layout);
    for (int i = 0; i < 100; ++i) next->go(0.4, 0.5);  // with nobody there
    next->run(0.4, 0.5, 1s);
    ASSERT_FALSE(next->readings.empty());
    EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin);
    EXPECT_EQ(next->odometer.restarts(), 0U);
    EXPECT_GT(next->readings.front().sigma_gap_m, 0.0) << "nobody knows the way it took";
    EXPECT_EQ(next->readings.back().sigma_gap_m, 0.0);
    EXPECT_LT(next->distance_from_truth_m(), 0.1 + bench.distance_from_truth_m());
    EXPECT_EQ(next->odometer.missed(), 0U) << "what was sent to nobody is not missing";
  }
}

TEST(CanOdometerMemory, IsNotBelievedWhenTheBaseBeganAnew) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  const auto next = next_process(bench, test::ticks_layout());
  next->base = FakeBase();
  next->go(0.0, 0.0, 2s);
  next->run(0.2, 0.2, 1s);
  ASSERT_FALSE(next->readings.empty());
  EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin + 1);
}

TEST(CanOdometerMemory, IsOfNoUseForOtherSignals) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  const auto next = next_process(bench, test::pose_layout());
  next->run(0.2, 0.2, 1s);
  ASSERT_FALSE(next->readings.empty());
  EXPECT_EQ(next->readings.front().origin, bench.readings.back().origin + 1);
  EXPECT_EQ(next->odometer.restarts(), 0U);
}

TEST(CanOdometerMemory, IsNotBelievedWithNumbersThatAreNone) {
  OdometerBench bench(test::ticks_layout());
  drive_a_course(bench);
  OdometerMemory memory;
  ASSERT_TRUE(bench.odometer.remember(memory));
  for (const std::size_t number : {1U, 2U, 3U, 5U, 12U, 13U}) {
    OdometerMemory bad = memory;
    bad.put(number, std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(bench.odometer.restore(bad)) << number;
  }
}

TEST(CanOdometerMemory, IsNoneOfSpeeds) {
  OdometerBench bench(test::speeds_layout());
  bench.run(0.3, 0.3, 1s);
  OdometerMemory memory;
  EXPECT_FALSE(bench.odometer.remember(memory)) << "nobody sums them up meanwhile";
}

}  // namespace
}  // namespace azimuth
