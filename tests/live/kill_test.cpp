// SIGKILL of the daemon harms neither the robot nor the recording.

#include <algorithm>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr int kStartsAtTheRaisedBaud = 10;

/// The number of kills, from the environment variable AZIMUTH_KILLS. The nightly run uses 100.
int kills() {
  const char* const wanted = std::getenv("AZIMUTH_KILLS");
  return wanted ? std::max(4, std::atoi(wanted)) : 30;
}

using Kill = test::Live;

/// Each killed daemon leaves a session open. The next daemon must find it, at a baud rate that it does not know.
void expect_odometry_after_each_kill(const std::filesystem::path& folder, const std::filesystem::path& rig,
                                     int starts) {
  for (int start = 1; start <= starts; ++start) {
    test::Daemon daemon(folder, rig);
    ASSERT_TRUE(daemon.has_odometry()) << "start " << start << ": " << daemon.standard_error();
    daemon.kill();
  }
}

TEST_F(Kill, EveryNextStartFindsTheSessionLeftOpen) {
  const test::Robot robot(folder());
  expect_odometry_after_each_kill(folder(), rig_, kills());
}

TEST_F(Kill, EveryNextStartFindsAControllerThatKeepsItsBaud) {
  const test::Robot robot(folder(), {"--baud", "115200", "--keep-baud"});
  expect_odometry_after_each_kill(folder(), rig_, kStartsAtTheRaisedBaud);
}

std::int64_t epoch_now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

TEST_F(Kill, CostsTheLogLessThanItsLastSecond) {
  const test::Robot robot(folder());
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> life_ms(700, 1500);
  Duration most_lost{};
  for (int kill = 0; kill < kills() / 4; ++kill) {
    const std::filesystem::path records = folder() / ("log-" + std::to_string(kill));
    test::Daemon daemon(folder(), rig_, {"--record", records});
    ASSERT_TRUE(daemon.has_odometry()) << daemon.standard_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(life_ms(random)));
    const Stamp killed = stamp_from_us(epoch_now_us());
    daemon.kill();

    const test::FieldLog log(test::only_session(records));
    EXPECT_TRUE(log.verification.passed()) << log.verification.text();
    EXPECT_GT(log.verification.recorded, 0U);
    EXPECT_LT(killed - log.run.odometry.back().stamp, 1s) << "killed " << kill << " times";
    EXPECT_LT(killed - log.run.bearings.back().stamp, 1s) << "killed " << kill << " times";
    most_lost = std::max(most_lost, killed - log.run.odometry.back().stamp);
  }
  RecordProperty("most_lost_ms", static_cast<int>(1e3 * to_seconds(most_lost)));
}

}  // namespace
}  // namespace azimuth
