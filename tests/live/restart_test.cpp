// A daemon that is stopped, or killed, and started again while its robot drives on: it knows where the robot is.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <random>
#include <thread>
#include <vector>

#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::seconds kSaveInterval{5};
constexpr Duration kPosesAgain = 3s;
constexpr double kThreeSigmaChi2 = 14.16;  // 99.73 % of three dimensions

/// How often; environment variable AZIMUTH_RESTARTS.
int restarts() {
  const char* const wanted = std::getenv("AZIMUTH_RESTARTS");
  return wanted ? std::max(2, std::atoi(wanted)) : 6;
}

Stamp now() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return Stamp{std::chrono::duration_cast<Duration>(since_epoch)};
}

Pose2 T_map_body_of(const pose_cov_t& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

double chi2(const Pose2& T_map_true, const pose_cov_t& pose) {
  Eigen::Vector3d error = T_map_body_of(pose).vector() - T_map_true.vector();
  error.z() = wrap(error.z());
  const Eigen::Map<const Eigen::Matrix3d> covariance(pose.covariance);
  return error.dot(covariance.ldlt().solve(error));
}

class Restarts : public test::Live {
 protected:
  std::filesystem::path session(int start) const { return test::only_session(records() / std::to_string(start)); }
  std::unique_ptr<test::Daemon> daemon(int start) const {
    const std::filesystem::path map = folder() / "state/map.azmap";
    return std::make_unique<test::Daemon>(
        folder(), rig_,
        std::vector<std::string>{"--status", "--record", records() / std::to_string(start), "--set",
                                 "daemon.map.file=" + map.string(), "--set",
                                 fmt::format("daemon.map.save_interval_s={}", kSaveInterval.count())});
  }
};

/// What became of one start.
struct Start {
  Stamp ended{};  ///< the process before it
  bool was_killed = false;
  bool searched = false;  ///< killed after a map was written and before the way since then was
};

TEST_F(Restarts, KnowWhereTheRobotIsAtOnce) {
  // GIVEN a robot that is tracked, and a map of it
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(8)) << running->standard_error();
  ASSERT_TRUE(running->logs("the map is saved to")) << running->standard_error();
  // WHEN its daemon ends again and again, every other time as nothing could prevent, and is started again at once
  std::mt19937_64 random(13);
  std::uniform_int_distribution<int> life_ms(1500, 4000);
  std::vector<Start> outcomes(static_cast<std::size_t>(restarts()));
  for (std::size_t start = 1; start <= outcomes.size(); ++start) {
    Start& outcome = outcomes[start - 1];
    outcome.was_killed = start % 2 == 0;
    outcome.ended = now();
    if (outcome.was_killed)
      running->kill();
    else
      ASSERT_EQ(running->stop(), 0);
    running = daemon(static_cast<int>(start));
    outcome.searched = !running->logs("odometry goes on from before the start");
    ASSERT_TRUE(!outcome.searched || outcome.was_killed) << "start " << start << ": " << running->standard_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(life_ms(random)));
  }
  ASSERT_EQ(running->stop(), 0);
  ASSERT_EQ(robot.end(), 0);
  // THEN poses come again soon, and the first is where the robot is
  const azimuth::Run truth = robot.truth();
  const pose_cov_t origin = test::published(session(0)).poses.front();
  const Pose2 T_map_world = T_map_body_of(origin) * inverse(test::true_pose(truth, stamp_from_us(origin.utime)));
  double sum = 0.0, worst = 0.0;
  std::vector<double> away_s;
  for (std::size_t start = 1; start <= outcomes.size(); ++start) {
    const Start& outcome = outcomes[start - 1];
    const auto folder = session(static_cast<int>(start));
    const test::FieldLog log(folder);
    EXPECT_TRUE(log.verification.passed()) << "start " << start << ": " << log.verification.text();
    EXPECT_GT(log.verification.recorded, 3U) << "start " << start;
    if (outcome.searched) continue;
    const pose_cov_t first = test::published(folder).poses.front();
    EXPECT_NE(first.health, pose_cov_t::HEALTH_LOST) << "start " << start;
    const Stamp stamp = stamp_from_us(first.utime);
    away_s.push_back(to_seconds(stamp - outcome.ended));
    EXPECT_LT(stamp - outcome.ended, kPosesAgain) << "start " << start;
    const double off = chi2(T_map_world * test::true_pose(truth, stamp), first);
    EXPECT_LT(off, kThreeSigmaChi2) << "start " << start << (outcome.was_killed ? ", after a kill" : "");
    sum += off;
    worst = std::max(worst, off);
  }
  const auto searched = std::ranges::count_if(outcomes, &Start::searched);
  EXPECT_LE(searched, 1 + std::ssize(outcomes) / 20) << "it takes a kill within some milliseconds";
  std::ranges::sort(away_s);
  fmt::print(
      "{} restarts, {} with a search: poses again after {:.2f} s (median), {:.2f} s at worst; first pose: ANEES "
      "{:.2f}, chi2 {:.2f} at "
      "worst\n",
      outcomes.size(), searched, away_s[away_s.size() / 2], away_s.back(), sum / static_cast<double>(outcomes.size()),
      worst);
}

TEST_F(Restarts, SearchForARobotWhoseControllerWasRestartedMeanwhile) {
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(16)) << running->standard_error();
  std::this_thread::sleep_for(kSaveInterval + 1s);
  running->kill();
  robot.obey("reboot=0xFF");
  running = daemon(1);
  EXPECT_TRUE(running->logs("odometry does not go on from before the start")) << running->standard_error();
  EXPECT_TRUE(running->logs("tracking")) << "it is found: " << running->standard_error();
  EXPECT_EQ(running->stop(), 0);
  const test::FieldLog log(session(1));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  EXPECT_EQ(test::published(session(1)).poses.front().health, pose_cov_t::HEALTH_LOST);
}

}  // namespace
}  // namespace azimuth
