// Odometry with wheel ticks and with a gyro.

#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "tests/drivers/pioneer/odometer_bench.hpp"

namespace azimuth::pioneer {
namespace {

using namespace std::chrono_literals;
using test::counter;
using test::kUnit_rad;

// ---- ticks ------------------------------------------------------------------------------------------------------

constexpr double kTicksPerMm = 128.0;

/// Drives straight, with 0.3 mm more per cycle than the SIP's whole millimetres show.
class TickBench : public test::OdometerBench {
 public:
  explicit TickBench(double claimed_ticks_per_mm = kTicksPerMm, const PioneerSettings& settings = {})
      : OdometerBench({.parameters = {}, .ticks_per_mm = claimed_ticks_per_mm}, settings) {}

  double x_mm = 0.0, turn_rad = 0.0;
  bool ticks_first = true, sends_ticks = true, line_works = true;

  void cycle(double distance_mm, double turned_rad = 0.0) {
    now += 100ms;
    x_mm += distance_mm;
    turn_rad += turned_rad;
    sip.x_units = counter(std::floor(x_mm), 0xFFFF);
    sip.heading_units = static_cast<std::int16_t>(std::lround(wrap(turn_rad) / kUnit_rad));
    const auto left = static_cast<std::int64_t>(std::llround(kTicksPerMm * (x_mm - 165.0 * turn_rad)));
    const auto right = static_cast<std::int64_t>(std::llround(kTicksPerMm * (x_mm + 165.0 * turn_rad)));
    const Frame ticks = encode_encoder({static_cast<std::int32_t>(left), static_cast<std::int32_t>(right)});
    if (!line_works) return;
    if (sends_ticks && ticks_first) hear(ticks, now - 2ms);
    hear_sip();
    if (sends_ticks && !ticks_first) hear(ticks, now + 2ms);
  }
};

TEST(PioneerOdometer, TicksAreFinerThanMillimetres) {
  for (const bool ticks_first : {true, false}) {
    TickBench bench;
    bench.ticks_first = ticks_first;
    for (int i = 0; i < 20; ++i) bench.cycle(30.3);
    ASSERT_TRUE(bench.odometer.uses_ticks());
    const double offset_mm = 1e3 * bench.last().T_odom_body.x_m - bench.x_mm;
    for (int i = 0; i < 200; ++i) {
      const std::size_t before = bench.readings.size();
      bench.cycle(30.3);
      ASSERT_EQ(bench.readings.size(), before + 1);
      EXPECT_NEAR(1e3 * bench.last().T_odom_body.x_m - bench.x_mm, offset_mm, 0.05);
    }
  }
}

TEST(PioneerOdometer, TicksOfAWrongSizeAreNotUsed) {
  for (const double claimed : {64.0, 120.0, 140.0, -128.0}) {
    TickBench bench(claimed);
    for (int i = 0; i < 100; ++i) bench.cycle(30.3);
    EXPECT_FALSE(bench.odometer.uses_ticks()) << claimed;
    EXPECT_NEAR(1e3 * bench.last().T_odom_body.x_m, bench.x_mm - 30.3, 1.0);
  }
}

TEST(PioneerOdometer, WithoutTicksTheSipGoesOn) {
  TickBench bench;
  for (int i = 0; i < 50; ++i) bench.cycle(30.3);
  ASSERT_TRUE(bench.odometer.uses_ticks());
  bench.sends_ticks = false;
  for (int i = 0; i < 50; ++i) bench.cycle(30.3);
  EXPECT_FALSE(bench.odometer.uses_ticks());
  EXPECT_NEAR(1e3 * bench.last().T_odom_body.x_m, bench.x_mm - 30.3, 3.0);
  EXPECT_GT(bench.readings.size(), 90U);
  bench.sends_ticks = true;
  for (int i = 0; i < 50; ++i) bench.cycle(30.3);
  EXPECT_TRUE(bench.odometer.uses_ticks());
  EXPECT_NEAR(1e3 * bench.last().T_odom_body.x_m, bench.x_mm - 30.3, 3.0);
}

TEST(PioneerOdometer, LostTicksLoseNoMotion) {
  std::mt19937 random(2);
  TickBench bench;
  for (int i = 0; i < 1000; ++i) {
    bench.sends_ticks = i == 999 || random() % 5 != 0;
    bench.cycle(30.3);
  }
  // Half a millimetre for each change between the two sources.
  EXPECT_NEAR(1e3 * bench.last().T_odom_body.x_m, bench.x_mm - 30.3, 10.0);
}

// Ticks alone would turn a straight motion and a turn in place into one wide arc.
TEST(PioneerOdometer, TheWayOfLostCyclesIsTheControllers) {
  TickBench bench;
  for (int i = 0; i < 20; ++i) bench.cycle(30.0);
  ASSERT_TRUE(bench.odometer.uses_ticks());
  const Pose2 before = bench.last().T_odom_body;
  bench.line_works = false;
  for (int i = 0; i < 3; ++i) bench.cycle(100.0);
  bench.line_works = true;
  bench.cycle(0.0, 0.5);
  EXPECT_TRUE(bench.odometer.uses_ticks());
  EXPECT_NEAR(bench.last().T_odom_body.x_m - before.x_m, 0.3, 0.002);
  EXPECT_NEAR(bench.last().T_odom_body.y_m, 0.0, 0.002);
  EXPECT_NEAR(bench.last().T_odom_body.heading_rad, 0.5, kUnit_rad);
}

TEST(PioneerOdometer, CalibratedTicksTurnToo) {
  PioneerSettings settings;
  settings.ticks_per_turn = 2.0 * kPi * 330.0 * kTicksPerMm;
  TickBench bench(kTicksPerMm, settings);
  for (int i = 0; i < 20; ++i) bench.cycle(30.0);
  ASSERT_TRUE(bench.odometer.uses_ticks());
  double expected_rad = bench.last().T_odom_body.heading_rad;
  for (int i = 0; i < 40; ++i) {
    bench.cycle(0.0, 0.0101);  // not a multiple of the SIP's unit
    expected_rad += 0.0101;
    EXPECT_NEAR(bench.last().T_odom_body.heading_rad, expected_rad, 1e-4);
  }
}

// ---- gyro -------------------------------------------------------------------------------------------------------

constexpr double kRad_per_count_and_s = degrees_to_rad(5.0 / 1023.0 * 120.0 * 1.626);

class GyroBench : public test::OdometerBench {
 public:
  explicit GyroBench(bool use_gyro = true) : OdometerBench({.parameters = {}, .use_gyro = use_gyro}) {}
  double wheels_rad = 0.0;

  /// The gyro measures `gyro_rad`, rounded to a whole count of its rate; the wheels measure `turned_rad`.
  void cycle(double gyro_rad, double turned_rad) {
    now += 100ms;
    wheels_rad += turned_rad;
    sip.heading_units = static_cast<std::int16_t>(std::lround(wrap(wheels_rad) / kUnit_rad));
    GyroPacket gyro;
    gyro.count = 4;
    const auto rate = static_cast<std::uint16_t>(std::lround(514.0 - gyro_rad / 0.1 / kRad_per_count_and_s));
    for (std::size_t i = 0; i < 4; ++i) gyro.samples[i].rate = rate;
    hear(encode_gyro(gyro), now - 2ms);
    hear_sip();
  }
  void stand(int cycles) {
    for (int i = 0; i < cycles; ++i) cycle(0.0, 0.0);
  }
};

constexpr double kTenCounts_rad = 10.0 * kRad_per_count_and_s * 0.1;  // in one cycle: 0.95 deg

TEST(PioneerOdometer, TheGyroCorrectsTheWheels) {
  GyroBench bench;
  bench.stand(20);
  // The wheels report 5 % too little.
  for (int i = 0; i < 100; ++i) bench.cycle(5.0 * kTenCounts_rad, 4.75 * kTenCounts_rad);
  const double per_cycle_rad = wrap(bench.last().T_odom_body.heading_rad - 495.0 * kTenCounts_rad) / 100.0;
  EXPECT_NEAR(per_cycle_rad, 0.0, 0.06 * kTenCounts_rad);
  EXPECT_EQ(bench.odometer.skids(), 0U);
}

TEST(PioneerOdometer, WithoutItsRateAtRestTheGyroIsNotUsed) {
  GyroBench bench;
  bench.stand(5);  // too short to learn the rate at rest
  for (int i = 0; i < 20; ++i) bench.cycle(kTenCounts_rad, 0.0);
  EXPECT_EQ(bench.last().T_odom_body.heading_rad, 0.0);
}

TEST(PioneerOdometer, WhereFirmwareCorrectsTheGyroIsNotUsedTwice) {
  GyroBench bench(false);
  bench.stand(30);
  for (int i = 0; i < 20; ++i) bench.cycle(5.0 * kTenCounts_rad, 0.0);
  EXPECT_EQ(bench.last().T_odom_body.heading_rad, 0.0);
}

TEST(PioneerOdometer, ASkidIsTheGyrosAndInDoubt) {
  GyroBench bench;
  bench.stand(20);
  bench.cycle(3.0 * kTenCounts_rad, 0.0);  // 2.9 deg
  EXPECT_NEAR(bench.last().T_odom_body.heading_rad, 3.0 * kTenCounts_rad, 1e-9);
  EXPECT_EQ(bench.odometer.skids(), 1U);
  EXPECT_GT(bench.last().sigma_gap_rad, 0.0);
}

TEST(PioneerOdometer, StandingWheelsAreBelievedOverAGyroThatDrifts) {
  GyroBench bench;
  bench.stand(20);
  for (int i = 0; i < 600; ++i) bench.cycle(0.1 * kTenCounts_rad, 0.0);
  EXPECT_EQ(bench.last().T_odom_body.heading_rad, 0.0);
}

TEST(PioneerOdometer, GyroPacketsThatAreMissingAreNotReplacedByOthers) {
  GyroBench bench;
  bench.stand(20);
  bench.now += 300ms;  // three lost cycles
  bench.cycle(kTenCounts_rad, 4.0 * kTenCounts_rad);
  EXPECT_NEAR(bench.last().T_odom_body.heading_rad, 4.0 * kTenCounts_rad, 0.5 * kUnit_rad + 1e-9);
}

}  // namespace
}  // namespace azimuth::pioneer
