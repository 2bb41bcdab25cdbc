#include "tools/import/wheel_odometry.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth::test {
namespace {

constexpr double kTrack_m = 0.4;

/// Distances rolled by both wheels [m] at 10 Hz. The robot stands, drives straight, turns both ways and reverses.
std::vector<WheelReading> drive(double seconds = 120.0) {
  std::vector<WheelReading> readings;
  double left_m = 0.0, right_m = 0.0;
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) {
    readings.push_back({stamp_from_us(100'000 * std::int64_t{i}), left_m, right_m});
    const double t_s = 0.1 * i, go_m_s = t_s < 2.0 ? 0.0 : 0.3 * std::sin(0.05 * t_s) + 0.1;
    const double turn_rad_s = 0.4 * std::sin(0.11 * t_s);
    left_m += 0.1 * (go_m_s - 0.5 * kTrack_m * turn_rad_s);
    right_m += 0.1 * (go_m_s + 0.5 * kTrack_m * turn_rad_s);
  }
  return readings;
}

/// The reading of a counter that wraps: it runs from `least` and has `range` counts.
double counted(double rolled_m, double count_m, double least, double range, bool whole) {
  const double counts = whole ? std::round(rolled_m / count_m) : rolled_m / count_m;
  const double beyond = std::fmod(counts - least, range);
  return count_m * (least + (beyond < 0.0 ? beyond + range : beyond));
}

struct Read {
  std::vector<OdometryReading> readings;
  std::vector<std::string> notes;
  std::string problem;
};

Read read(std::vector<WheelReading> readings, double count_m) {
  Read result;
  auto odometry = wheel_odometry(std::move(readings), {count_m, count_m}, kTrack_m, "wheels", result.notes);
  if (odometry)
    result.readings = *odometry;
  else
    result.problem = text(odometry.error());
  return result;
}

struct Counter {
  const char* name;
  double count_m, least, range;
  bool whole;
};
/// Prints the name of a counter in the output of a test.
std::ostream& operator<<(std::ostream& out, const Counter& counter) { return out << counter.name; }

class Counters : public testing::TestWithParam<Counter> {};

TEST_P(Counters, ThatWrapAreUnwrapped) {
  const auto& [name, count_m, least, range, whole] = GetParam();
  std::vector<WheelReading> wrapped = drive();
  for (WheelReading& reading : wrapped) {
    reading.left_m = counted(reading.left_m, count_m, least, range, whole);
    reading.right_m = counted(reading.right_m + 0.3 * range * count_m, count_m, least, range, whole);
  }
  const Read straight = read(drive(), count_m), result = read(wrapped, count_m);
  ASSERT_EQ(result.problem, "");
  EXPECT_EQ(result.notes.size(), 2u) << "each wheel is named";
  ASSERT_EQ(result.readings.size(), straight.readings.size());
  for (std::size_t i = 0; i < result.readings.size(); i += 50) {
    const Pose2 &pose = result.readings[i].T_odom_body, &expected = straight.readings[i].T_odom_body;
    EXPECT_LT((pose.position() - expected.position()).norm(), 0.02) << "at reading " << i;
    EXPECT_LT(std::abs(wrap(pose.heading_rad - expected.heading_rad)), 0.02) << "at reading " << i;
    EXPECT_EQ(result.readings[i].origin, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Ranges, Counters,
                         testing::Values(Counter{"plus_minus_pi", 0.1, -kPi, 2.0 * kPi, false},
                                         Counter{"to_two_pi", 0.1, 0.0, 2.0 * kPi, false},
                                         Counter{"degrees", 0.1 * kPi / 180.0, 0.0, 360.0, false},
                                         Counter{"unsigned_8_bits", 0.004, 0.0, 256.0, true},
                                         Counter{"signed_8_bits", 0.004, -128.0, 256.0, true},
                                         Counter{"signed_16_bits", 0.0001, -32768.0, 65536.0, true},
                                         Counter{"unsigned_32_bits", 1e-9, 0.0, 4294967296.0, true},
                                         Counter{"hoverboard", 0.0003, 0.0, 9000.0, true},
                                         Counter{"a_range_of_its_own", 0.0005, 0.0, 2777.0, true}),
                         [](const auto& each) { return each.param.name; });

TEST(WheelOdometry, GoesOnWhereCountersBeginAtZeroAgain) {
  std::vector<WheelReading> readings = drive();
  const Read whole = read(readings, 0.001);
  const WheelReading begin = readings[700];
  for (std::size_t i = 700; i < readings.size(); ++i) {
    readings[i].left_m -= begin.left_m;
    readings[i].right_m -= begin.right_m;
  }
  const Read result = read(readings, 0.001);
  ASSERT_EQ(result.problem, "");
  EXPECT_EQ(result.readings[699].origin, 0u);
  EXPECT_EQ(result.readings[700].origin, 1u);
  EXPECT_GT(result.readings[700].sigma_gap_m, 0.0);
  EXPECT_LT((result.readings.back().T_odom_body.position() - whole.readings.back().T_odom_body.position()).norm(), 0.15)
      << "but for the tenth of a second that nobody knows";
}

TEST(WheelOdometry, RefusesStepsThatNoWheelMakes) {
  std::vector<WheelReading> readings = drive();
  readings[500].left_m += 20.0;
  const Read result = read(readings, 0.001);
  EXPECT_NE(result.problem.find("wheels: the left wheel steps by "), std::string::npos) << result.problem;
  EXPECT_NE(result.problem.find(" 50.0 s after its first reading, which no wheel does"), std::string::npos)
      << result.problem;
}

TEST(WheelOdometry, RefusesACounterThatWrapsBetweenTwoReadings) {
  std::vector<WheelReading> readings;
  for (int i = 0; i < 200; ++i) {  // 100 of 256 counts per reading
    const double rolled_m = 0.005 * ((100 * i) % 256);
    readings.push_back({stamp_from_us(1'000'000 * std::int64_t{i}), rolled_m, rolled_m});
  }
  const Read result = read(readings, 0.005);
  EXPECT_NE(result.problem.find("stays within 256 (8 bits)"), std::string::npos) << result.problem;
  EXPECT_NE(result.problem.find("record it more often"), std::string::npos) << result.problem;
}

TEST(WheelOdometry, LeavesAWheelThatNeverWrapsAlone) {
  const Read result = read(drive(), 0.001);
  EXPECT_EQ(result.problem, "");
  EXPECT_TRUE(result.notes.empty());
  const std::vector<WheelReading> standing(100, WheelReading{});
  std::vector<WheelReading> trembling = standing;
  for (std::size_t i = 0; i < trembling.size(); ++i) {
    trembling[i].stamp = stamp_from_us(100'000 * static_cast<std::int64_t>(i));
    trembling[i].left_m = i % 2 == 0 ? 0.0 : 0.001;
  }
  EXPECT_EQ(read(trembling, 0.001).problem, "") << "a tick to and fro";
  EXPECT_TRUE(read(trembling, 0.001).notes.empty());
}

}  // namespace
}  // namespace azimuth::test
