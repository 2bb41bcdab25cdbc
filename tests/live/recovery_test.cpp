// Trouble during a drive: the map and the pose are kept, and the daemon continues by itself.

#include <algorithm>
#include <gmock/gmock.h>
#include <thread>

#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr int kLandmarks = 8;          // landmarks mapped before the trouble
constexpr auto kDriveAfterwards = 3s;  // long enough to see each landmark from another side
constexpr Duration kRecovery = 2s;     // docs/architecture.md, "When something fails"

class Recovery : public test::Live {
 protected:
  /// Drives until there is a map, causes the trouble, waits until odometry resumes, and drives on.
  void drive_through(const std::string& trouble) {
    const auto daemon = recording_daemon();
    ASSERT_TRUE(daemon->has_landmarks(kLandmarks)) << daemon->standard_error();
    ASSERT_THAT(robot_.obey(trouble), HasSubstr(trouble));
    ASSERT_TRUE(daemon->has_odometry(2)) << daemon->standard_error();
    std::this_thread::sleep_for(kDriveAfterwards);
    ASSERT_EQ(daemon->stop(), 0);
    ASSERT_EQ(robot_.end(), 0);
    published_ = test::published(test::only_session(records()));
  }

  /// Expects that neither the pose nor the map was lost at any time.
  void expect_nothing_forgotten(Stamp trouble) const {
    for (const pose_cov_t& pose : published_.poses) ASSERT_NE(pose.health, pose_cov_t::HEALTH_LOST) << pose.utime;
    EXPECT_EQ(published_.poses.back().health, pose_cov_t::HEALTH_TRACKING);
    const map_chunk_t before = test::map_before(published_, trouble);
    EXPECT_GE(before.n, kLandmarks);
    test::expect_unmoved(before, published_.map_chunks.back());
    test::expect_at_true_place(published_, robot_.truth());
  }

  static void record_recovery(Duration duration) {
    RecordProperty("recovery_ms", static_cast<int>(1e3 * to_seconds(duration)));
  }

  test::Robot robot_{folder()};
  test::RecordedMessages published_;
};

/// The first reading with a new origin, after the odometer restarted.
const OdometryReading* first_of_new_origin(const std::vector<OdometryReading>& readings) {
  const auto found = std::ranges::find_if(
      readings, [&](const OdometryReading& reading) { return reading.origin != readings.front().origin; });
  return found == readings.end() ? nullptr : &*found;
}

TEST_F(Recovery, AnUnpluggedCableCostsAtMostTwoSecondsAndNoLandmark) {
  ASSERT_NO_FATAL_FAILURE(drive_through("unplug=1"));
  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  const auto& readings = log.run.odometry;
  const auto again = std::ranges::upper_bound(readings, robot_.when("plugged in again"), {}, &OdometryReading::stamp);
  ASSERT_NE(again, readings.end());
  EXPECT_EQ(again->origin, readings.front().origin) << "the controller counted on";
  EXPECT_LT(again->stamp - robot_.when("plugged in again"), kRecovery);
  record_recovery(again->stamp - robot_.when("plugged in again"));
  expect_nothing_forgotten(robot_.when("unplugged"));
}

class Reboot : public Recovery, public testing::WithParamInterface<std::string> {};

TEST_P(Reboot, GivesTheOdometerANewOriginAndCostsNoLandmark) {
  ASSERT_NO_FATAL_FAILURE(drive_through(GetParam()));
  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  const OdometryReading* const again = first_of_new_origin(log.run.odometry);
  ASSERT_TRUE(again);
  EXPECT_LT(again->stamp - robot_.when("session over"), kRecovery);
  record_recovery(again->stamp - robot_.when("session over"));
  expect_nothing_forgotten(robot_.when("session over"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Reboot, testing::Values("reboot=0xFF", "reboot=0xFE"),
                         [](const auto& kind) { return kind.param.substr(7); });

TEST_F(Recovery, ACameraAndRobotThatDiedComeBack) {
  const auto daemon = recording_daemon();
  ASSERT_TRUE(daemon->has_landmarks(kLandmarks)) << daemon->standard_error();
  ASSERT_EQ(robot_.end(SIGKILL), 128 + SIGKILL);
  ASSERT_TRUE(daemon->logs("warning camera: ")) << daemon->standard_error();

  // The new robot stands at the start of its path, where the daemon does not expect it. Only the arrival of poses is
  // required.
  test::Robot another(folder());
  ASSERT_TRUE(daemon->has_odometry(2)) << daemon->standard_error();
  ASSERT_TRUE(daemon->logs("camera: running", 2)) << daemon->standard_error();
  std::this_thread::sleep_for(kDriveAfterwards);
  ASSERT_EQ(daemon->stop(), 0);
  ASSERT_EQ(another.end(), 0);

  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  const Stamp restart = another.truth().truth.front().stamp;
  const auto is_later = [&](const auto& sample) { return sample.stamp > restart; };
  EXPECT_GT(std::ranges::count_if(log.run.odometry, is_later), 10);
  EXPECT_GT(std::ranges::count_if(log.run.bearings, is_later), 5);
  EXPECT_GT(std::ranges::count_if(log.replayed.estimates, is_later), 5) << "and each gave a pose";
  const status_t status = test::published(test::only_session(records())).statuses.back();
  EXPECT_EQ(status.odometer_reconnects, 1);
  EXPECT_EQ(status.camera_reconnects, 1);
}

}  // namespace
}  // namespace azimuth
