// The daemon on a robot without any trouble, from start to stop.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <thread>

#include "tests/live/live.hpp"
#include "tests/live/text.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using test::kPatience;
using testing::HasSubstr;

using Running = test::Live;

TEST_F(Running, GivesPosesAndALogThatReplaysIdentically) {
  test::Robot robot(folder());
  const auto daemon = recording_daemon();
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  std::this_thread::sleep_for(6s);
  ASSERT_EQ(daemon->stop(), 0);
  ASSERT_EQ(robot.end(), 0);

  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  EXPECT_GT(log.verification.recorded, 10U);
  EXPECT_EQ(log.run.skipped.text(), "");
  EXPECT_THAT(daemon->standard_error(), HasSubstr(fmt::format("digest {:016x}", log.replayed.digest)));

  const test::RecordedMessages published = test::published(test::only_session(records()));
  ASSERT_GT(published.poses.size(), 2 * log.verification.recorded) << "predictions between the steps as well";
  EXPECT_EQ(published.poses.back().health, pose_cov_t::HEALTH_TRACKING);
  test::expect_at_true_place(published, robot.truth());
  ASSERT_GE(published.statuses.size(), 3U) << "once a second";
  const status_t& status = published.statuses.back();
  EXPECT_THAT(status.odometer, HasSubstr("running (p3dx-sh Azimuth_sim"));
  EXPECT_THAT(status.camera, HasSubstr("running"));
  EXPECT_THAT(status.recorder, HasSubstr("000.lcm"));
  EXPECT_GT(status.battery_v, 10.0);
  EXPECT_EQ(status.odometry_refused + status.bearings_refused + status.record_losses, 0);
}

TEST_F(Running, SigtermClosesTheSessionWithinASecond) {
  test::Robot robot(folder());
  test::Daemon daemon(folder(), rig_);
  ASSERT_TRUE(daemon.has_odometry()) << daemon.standard_error();
  ASSERT_TRUE(robot.tells("session open"));
  const auto stop = Clock::now();
  EXPECT_EQ(daemon.stop(), 0);
  EXPECT_LT(Clock::now() - stop, 1s);
  EXPECT_TRUE(robot.tells("session over")) << robot.told();
}

TEST_F(Running, WaitsForARobotThatIsNotThereYet) {
  const auto daemon = recording_daemon();
  const std::string trouble = "warning " + test::Robot::device(folder()).string() + ": open: No such file or directory";
  ASSERT_TRUE(daemon->logs(trouble)) << daemon->standard_error();
  std::this_thread::sleep_for(3s);  // time for more attempts
  EXPECT_EQ(test::occurrences(daemon->standard_error(), trouble), 1U) << daemon->standard_error();
  EXPECT_EQ(daemon->wait(0ms), std::nullopt);

  test::Robot robot(folder());
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  ASSERT_TRUE(daemon->has_landmarks(1)) << daemon->standard_error();
  EXPECT_EQ(daemon->stop(), 0);
  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  EXPECT_GT(log.verification.recorded, 0U);
}

}  // namespace
}  // namespace azimuth
