// Odometry from packets: counter wraps, losses, and the stated uncertainty.

#include "drivers/pioneer/odometer.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <random>
#include <rapidcheck/gtest.h>

#include "tests/drivers/pioneer/odometer_bench.hpp"

namespace azimuth::pioneer {
namespace {

using namespace std::chrono_literals;
using test::ByteVector;
using test::counter;
using test::kUnit_rad;
using test::OdometerBench;

TEST(PioneerOdometer, BeginsAtTheOriginWhateverTheCountersSay) {
  OdometerBench bench;
  bench.sip.x_units = 1234;
  bench.sip.heading_units = 1000;
  bench.hear_sip();
  EXPECT_EQ(bench.last().T_odom_body, Pose2{});
  EXPECT_EQ(bench.last().sigma_gap_m, 0.0);
  bench.now += 100ms;
  bench.sip.x_units = 1234 + 100;  // straight ahead along the heading of 1000 units
  bench.hear_sip();
  EXPECT_NEAR(bench.last().T_odom_body.x_m, 0.1 * std::cos(1000 * kUnit_rad), 1e-12);
  EXPECT_NEAR(bench.last().T_odom_body.y_m, -0.1 * std::sin(1000 * kUnit_rad), 1e-12);
}

// 1.5 m/s is 150 mm per cycle, or 300 mm if one is lost.
TEST(PioneerOdometer, LosesNoDistanceWithOneSipInFiveLostOn15And16Bits) {
  for (const unsigned mask : {0x7FFFU, 0xFFFFU}) {
    OdometerBench bench;
    std::mt19937 random(1);
    for (int i = 0; i <= 1000; ++i, bench.now += 100ms) {
      bench.sip.x_units = counter(150.0 * i, mask);
      bench.sip.y_units = counter(65536.0 - 20.0 * i, mask);
      if (i == 0 || i == 1000 || random() % 5 != 0) bench.hear_sip();
    }
    EXPECT_LT(bench.readings.size(), 850U);
    EXPECT_NEAR(bench.last().T_odom_body.x_m, 150.0, 1e-9) << mask;
    EXPECT_NEAR(bench.last().T_odom_body.y_m, -20.0, 1e-9) << mask;
    for (const auto& reading : bench.readings) EXPECT_EQ(reading.sigma_gap_m, 0.0) << "nothing to doubt";
  }
}

TEST(PioneerOdometer, HeadingWrapsExactlyAndCountsWholeTurns) {
  OdometerBench bench;
  for (int i = 0; i <= 4096; ++i, bench.now += 100ms) {  // 50 turns of 4096 units
    const int units = (50 * i) % 4096;
    bench.sip.heading_units = static_cast<std::int16_t>(units >= 2048 ? units - 4096 : units);
    bench.hear_sip();
    ASSERT_NEAR(wrap(bench.last().T_odom_body.heading_rad - units * kUnit_rad), 0.0, 1e-9);
  }
  EXPECT_NEAR(wrap(bench.last().T_odom_body.heading_rad), 0.0, 1e-9);
  EXPECT_EQ(bench.odometer.gaps(), 0U);
}

TEST(PioneerOdometer, CountsInTheRobotsUnits) {
  OdometerSetup setup;
  setup.parameters = {.distance_m_per_unit = 0.485e-3, .heading_units_per_turn = 1024.0};
  OdometerBench bench(setup);
  bench.hear_sip();
  bench.now += 100ms;
  bench.sip.x_units = 200;
  bench.sip.heading_units = 64;
  bench.hear_sip();
  EXPECT_NEAR(bench.last().T_odom_body.x_m, 0.097, 1e-12);
  EXPECT_NEAR(bench.last().T_odom_body.heading_rad, 2.0 * kPi / 16.0, 1e-12);
}

// For any path and any losses the pose must equal the controller's, as long as no loss hides half of a counter's range.
RC_GTEST_PROP(PioneerOdometer, FollowsTheControllersPose, ()) {
  OdometerBench bench;
  double x_mm = 0.0, y_mm = 0.0;
  int heading_units = 0;
  bench.hear_sip();
  const auto steps = *rc::gen::container<std::vector<std::tuple<int, int, int, bool>>>(
      rc::gen::tuple(rc::gen::inRange(-300, 300), rc::gen::inRange(-300, 300), rc::gen::inRange(-400, 400),
                     rc::gen::arbitrary<bool>()));
  for (const auto& [dx_mm, dy_mm, turn_units, is_heard] : steps) {
    x_mm += dx_mm;
    y_mm += dy_mm;
    heading_units += turn_units;
    bench.now += 100ms;
    bench.sip.x_units = counter(x_mm + 65536e3, 0xFFFF);
    bench.sip.y_units = counter(y_mm + 65536e3, 0xFFFF);
    bench.sip.heading_units = static_cast<std::int16_t>(((heading_units + 4096000 + 2048) % 4096) - 2048);
    if (!is_heard) continue;
    bench.hear_sip();
    const Pose2& T_odom_body = bench.last().T_odom_body;
    RC_ASSERT(std::abs(T_odom_body.x_m - 1e-3 * x_mm) < 1e-9);
    RC_ASSERT(std::abs(T_odom_body.y_m - 1e-3 * y_mm) < 1e-9);
    RC_ASSERT(std::abs(wrap(T_odom_body.heading_rad - heading_units * kUnit_rad)) < 1e-9);
  }
}

TEST(PioneerOdometer, BelievesAndDoubtsAStepTooLargeToBeTrue) {
  OdometerBench bench;
  bench.hear_sip();
  bench.now += 100ms;
  bench.sip.x_units = 320;  // 2.2 m/s allow 330 mm
  bench.hear_sip();
  EXPECT_EQ(bench.last().sigma_gap_m, 0.0);
  bench.now += 100ms;
  bench.sip.x_units = 320 + 1000;
  bench.hear_sip();
  EXPECT_NEAR(bench.last().T_odom_body.x_m, 1.32, 1e-12);
  EXPECT_NEAR(bench.last().sigma_gap_m, 1.0, 1e-12);
  bench.now += 100ms;
  bench.hear_sip();
  EXPECT_EQ(bench.last().sigma_gap_m, 0.0);
  EXPECT_EQ(bench.odometer.gaps(), 1U);
  bench.now += 100ms;
  bench.sip.heading_units = 1000;
  bench.hear_sip();
  EXPECT_NEAR(bench.last().sigma_gap_rad, 1000 * kUnit_rad, 1e-12);
}

// A damaged packet with a valid checksum. A jump of half the counter's range is ambiguous: forwards or backwards.
TEST(PioneerOdometer, ComesBackFromAJumpOfHalfTheCounter) {
  for (const int speed : {40, -40}) {
    for (const unsigned flipped : {0x4000U, 0x2000U, 0x8000U}) {
      OdometerBench bench;
      for (int i = 0; i <= 20; ++i, bench.now += 100ms) {
        bench.sip.x_units = counter(20000.0 + speed * i, 0xFFFF);
        bench.sip.y_units = counter(30000.0 - speed * i, 0xFFFF);
        if (i == 10) bench.sip.x_units = static_cast<std::uint16_t>(bench.sip.x_units ^ flipped);
        bench.hear_sip();
      }
      EXPECT_NEAR(bench.last().T_odom_body.x_m, 0.02 * speed, 1e-9) << flipped;
      EXPECT_NEAR(bench.last().T_odom_body.y_m, -0.02 * speed, 1e-9) << flipped;
    }
  }
}

TEST(PioneerOdometer, DoubtsALongGap) {
  OdometerBench bench;
  bench.hear_sip();
  bench.now += 1s;
  bench.sip.x_units = 900;
  bench.hear_sip();
  EXPECT_NEAR(bench.last().T_odom_body.x_m, 0.9, 1e-12);
  EXPECT_GT(bench.last().sigma_gap_m, 0.05);
  EXPECT_LT(bench.last().sigma_gap_m, 0.2);
  bench.now += 8s;  // long enough for an unobserved wrap of the counters
  bench.hear_sip();
  EXPECT_GT(bench.last().sigma_gap_m, 16.0);
}

TEST(PioneerOdometer, ANewSessionIsANewOriginWithDoubtAboutTheOutage) {
  OdometerBench bench;
  for (int i = 0; i < 10; ++i, bench.now += 100ms) {
    bench.sip.x_units = static_cast<std::uint16_t>(50 * i);
    bench.hear_sip();
  }
  const std::uint32_t origin = bench.last().origin;
  EXPECT_NEAR(bench.odometer.speed_m_s(), 0.5, 1e-9);
  bench.now += 1900ms;  // 2 s since the last SIP
  bench.odometer.begin_session({});
  bench.sip.x_units = 0;
  bench.hear_sip();
  EXPECT_EQ(bench.last().origin, origin + 1);
  EXPECT_EQ(bench.last().T_odom_body, Pose2{});
  EXPECT_NEAR(bench.last().sigma_gap_m, 0.05 + 2.0 * 0.5, 1e-9);
  EXPECT_NEAR(bench.last().sigma_gap_rad, 0.05 + 2.0 * 0.45, 1e-9) << "it did not turn before, but may have since";
  bench.now += 100ms;
  bench.hear_sip();
  EXPECT_EQ(bench.last().sigma_gap_m, 0.0);
}

TEST(PioneerOdometer, StampsTheBeginOfTheCycle) {
  PioneerSettings settings;
  settings.usb_latency_s = 0.002;
  Odometer odometer(settings, 10s);
  odometer.begin_session({});
  const auto byte_time = 1ms;
  const ByteVector encoder = test::data_of(encode_encoder({})), sip = test::data_of(encode_sip({}));
  const auto second_at = test::kBenchStart + byte_time * static_cast<int>(encoder.size() + kFrameOverhead);
  EXPECT_FALSE(odometer.add(decoded({encoder, test::kBenchStart, true}), byte_time));
  const auto reading = odometer.add(decoded({sip, second_at, true}), byte_time);
  ASSERT_TRUE(reading);
  // One byte was already on the wire before it had arrived completely.
  EXPECT_EQ(reading->stamp.time_since_epoch(), test::kBenchStart.time_since_epoch() + 10s - 1ms - 2ms);
}

TEST(PioneerOdometer, StampsIncreaseWhateverTheClockSays) {
  OdometerBench bench;
  for (const auto at : {0ms, 100ms, 90ms, 90ms, 91ms, 300ms}) {
    bench.now = test::kBenchStart + at;
    bench.hear_sip();
  }
  ASSERT_EQ(bench.readings.size(), 6U);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_GT(bench.readings[i].stamp, bench.readings[i - 1].stamp);
}

}  // namespace
}  // namespace azimuth::pioneer
