// SIGHUP to the daemon while its robot drives on.

#include <algorithm>
#include <csignal>
#include <thread>

#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kReloads = 3;

using ReloadLive = test::Live;

TEST_F(ReloadLive, KeepsPoseAndMapAndEachSessionReplays) {
  // GIVEN a robot that is tracked
  test::Robot robot(folder());
  const auto daemon = recording_daemon();
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  ASSERT_TRUE(daemon->has_landmarks(5)) << daemon->standard_error();
  std::this_thread::sleep_for(3s);
  // WHEN its daemon reads its configuration anew while the robot drives on
  for (std::size_t reload = 1; reload <= kReloads; ++reload) {
    daemon->signal(SIGHUP);
    ASSERT_TRUE(daemon->logs("map: goes on with its", reload)) << daemon->standard_error();
    ASSERT_TRUE(daemon->has_odometry(reload + 1)) << daemon->standard_error();
    std::this_thread::sleep_for(3s);
  }
  EXPECT_EQ(daemon->stop(), 0);
  EXPECT_EQ(robot.end(), 0);
  // THEN each session replays by itself, and no session has a pose with health `lost`
  std::vector<std::filesystem::path> sessions;
  for (const auto& entry : std::filesystem::directory_iterator(records())) sessions.push_back(entry.path());
  std::ranges::sort(sessions);
  ASSERT_EQ(sessions.size(), kReloads + 1);
  test::RecordedMessages ends;
  for (const std::filesystem::path& session : sessions) {
    const test::FieldLog log(session);
    EXPECT_TRUE(log.verification.passed()) << session << ": " << log.verification.text();
    EXPECT_GT(log.verification.recorded, 10U) << session;
    ends.poses.push_back(test::published(session).poses.front());
    ends.poses.push_back(test::published(session).poses.back());
    const auto is_lost = [](const pose_cov_t& pose) { return pose.health == pose_cov_t::HEALTH_LOST; };
    EXPECT_TRUE(std::ranges::none_of(test::published(session).poses, is_lost)) << session;
  }
  test::expect_at_true_place(ends, robot.truth());  // relative to the very first pose
}

}  // namespace
}  // namespace azimuth
