// Half an hour of drive with a fault every ten seconds: the driver and an estimator must recover from each.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <span>

#include "tests/robot/agreement.hpp"
#include "tests/robot/drive_with_faults.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

std::vector<PassingFault> all_faults() {
  return {
      {"noise=0.002", "noise=0", 4s},
      {"noise=0.01", "noise=0", 1s},  // with more noise some damaged packets have a valid checksum
      {"lose_bytes=0.005", "lose_bytes=0", 4s},
      {"lose_sips=0.3", "lose_sips=0", 5s},
      {"silence=0.4", "", 400ms},
      {"silence=1.5", "", 1500ms},
      {"silence=3", "", 3s, true},
      {"unplug=0.3", "", 300ms, true},
      {"unplug=3", "", 3s, true},
      {"reboot=0xFF", "", 500ms, true},
      {"reboot=0xFE", "", 500ms, true},
      {"sonar", "sonar=off", 3s},
      {"sip_id=0x32", "sip_id=moving", 3s},
      {"gyro=always", "gyro=off", 3s},
      {"encoder=off", "encoder=on_request", 3s},
      {"encoder=always", "encoder=on_request", 3s},
      {"jump=1", "jump=0", 3s},
      {"stall=left", "stall=none", 2s},
      {"bumpers=both", "bumpers=none", 2s},
      {"hostbaud=refused", "hostbaud=obeyed", 2s},
      {"bad_config_checksum", "", 1s},
  };
}

void print(const DriveSetup& settings, const DriveResult& result, const DrivenRobot& robot) {
  std::printf(
      "seed %lu: %zu faults, %lu sessions, %zu readings in %lu turns; position error mean %.3f m, max %.3f m, settled "
      "%.3f m; %zu of %zu estimates not tracking, %zu lost\n",
      settings.seed, result.struck.size(), robot.state().sessions, robot.sightings.size(), robot.turns,
      result.mean_error_m, result.max_error_m, result.max_settled_error_m, result.not_tracking, result.estimates,
      result.lost);
}

/// Odometry must return within two seconds of a fault's end, or within five if the link or the session was lost.
void expect_always_back(const DriveResult& result) {
  Duration longest{}, longest_link{};
  for (const Struck& struck : result.struck) {
    ASSERT_NE(struck.back, Stamp::max()) << struck.fault;
    const Duration away = struck.back - struck.ended;
    EXPECT_LT(away, struck.loses_link ? 5s : 2s) << struck.fault << " at " << to_seconds(struck.ended) << " s";
    Duration& so_far = struck.loses_link ? longest_link : longest;
    so_far = std::max(so_far, away);
  }
  std::printf("odometry back after %.2f s at most, %.2f s where the link was lost\n", to_seconds(longest),
              to_seconds(longest_link));
}

/// The unobserved motion must be within two of the standard deviations that the driver states.
void expect_gaps_covered(std::span<const Sighting> sightings) {
  for (std::size_t i = 1; i < sightings.size(); ++i) {
    const Sighting &before = sightings[i - 1], &now = sightings[i];
    if (now.reading.origin == before.reading.origin) continue;
    const Pose2 missed = inverse(before.T_odom_wheels) * now.T_odom_wheels;
    EXPECT_LE(missed.position().norm(), 2.0 * now.reading.sigma_gap_m) << to_seconds(now.latched_at) << " s";
    EXPECT_LE(std::abs(missed.heading_rad), 2.0 * now.reading.sigma_gap_rad) << to_seconds(now.latched_at) << " s";
  }
}

class EnduranceTest : public testing::TestWithParam<std::uint64_t> {
 public:
  /// Drives for half an hour. The limits of the errors: without faults the largest error in the lab is 0.3 m; during a
  /// fault the robot moves unobserved, at most 1.7 m in the longest outage.
  static void endure(const DriveSetup& settings) {
    DriveWithFaults drive(settings);
    const DriveResult result = drive.run(30min);
    const PioneerState& state = drive.robot().state();
    print(settings, result, drive.robot());
    EXPECT_EQ(state.connection, Connection::running) << state.trouble;
    EXPECT_EQ(state.refused_readings, 0U);
    expect_always_back(result);
    expect_gaps_covered(drive.robot().sightings);
    expect_agreement(drive.robot().sightings, 0.004);
    // Opening a session allocates for its parameters; nothing else may allocate.
    EXPECT_LE(drive.robot().allocations_while_running, 4 * state.sessions);
    EXPECT_EQ(result.lost, 0U);
    EXPECT_LT(result.mean_error_m, 0.1);
    EXPECT_LT(result.max_settled_error_m, 0.5);
    EXPECT_LT(result.max_error_m, 2.0);
  }
};

TEST_P(EnduranceTest, AFaultEveryTenSeconds) {
  endure({.seed = GetParam(), .faults = all_faults(), .watchdog = 700ms});
}

/// The robot keeps driving while the link is down.
TEST_P(EnduranceTest, AFaultEveryTenSecondsDrivingOnUnseen) { endure({.seed = GetParam(), .faults = all_faults()}); }

INSTANTIATE_TEST_SUITE_P(Seeds, EnduranceTest, testing::Values(1, 2, 3, 4, 5), PrintedName());

TEST(Endurance, NothingAllocatesWhileTheSessionLasts) {
  std::vector<PassingFault> faults = all_faults();
  std::erase_if(faults, [](const PassingFault& fault) { return fault.loses_link; });
  DriveWithFaults drive({.seed = 6, .faults = faults});
  drive.run(30s);
  const std::size_t before = drive.robot().allocations_while_running;
  drive.run(10min);
  EXPECT_EQ(drive.robot().state().sessions, 1U);
  EXPECT_EQ(drive.robot().allocations_while_running, before);
}

TEST(Endurance, TheSameSeedGivesTheSameReadings) {
  const auto readings = [](std::uint64_t seed) {
    DriveWithFaults drive({.seed = seed, .faults = all_faults()});
    drive.run(5min);
    std::vector<OdometryReading> all;
    for (const Sighting& sighting : drive.robot().sightings) all.push_back(sighting.reading);
    return all;
  };
  const auto first = readings(9);
  EXPECT_GT(first.size(), 2000U);
  EXPECT_TRUE(first == readings(9));
  EXPECT_FALSE(first == readings(10));
}

}  // namespace
}  // namespace azimuth::test
