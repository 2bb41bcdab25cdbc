// Runs azimuth-ros2 as a process between LCM and Fast DDS, on a loopback interface of its own (in_namespace.sh).

#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/status_t.hpp>
#include <cmath>
#include <csignal>
#include <gmock/gmock.h>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string_view>

#include "drivers/ros/make_messages.hpp"
#include "drivers/ros/serialize.hpp"
#include "tests/daemon/child_process.hpp"
#include "tests/daemon/run_files.hpp"
#include "tests/tools/ros2/dds_reader.hpp"
#include "tools/ros2/bridge/bridge.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::int64_t kBegin_us = 1'700'000'000'000'000;
constexpr auto kPatience = 30s;

pose_cov_t pose_number(int i) {
  pose_cov_t pose{};
  pose.utime = kBegin_us + 20'000LL * i;
  pose.x_m = 0.01 * i;
  pose.y_m = -0.02 * i;
  pose.heading_rad = 0.001 * i;
  for (int k = 0; k < 9; ++k) pose.covariance[k] = k % 4 == 0 ? 0.5 + i : 0.001 * k;
  pose.odom_x_m = 5.0 + 0.01 * i;
  return pose;
}

/// Removes the padding to a multiple of four bytes, whose length the options of the CDR header give.
std::string unfilled(std::string message) {
  const auto filled = static_cast<std::size_t>(message.at(3) & 3);
  message.resize(message.size() - filled);
  message[3] = '\0';
  return message;
}

class Interop : public testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{AZIMUTH_ROS2, "--interface", "lo"};
    command.insert(command.end(), more.begin(), more.end());
    bridge_ = std::make_unique<ChildProcess>(command, folder_.path());
  }
  bool says(const std::string& words) const {
    return eventually([&] { return bridge_->standard_error().find(words) != std::string::npos; }, kPatience);
  }
  /// Waits until `times` subscribers have been discovered. A volatile topic delivers no message before that.
  bool is_heard(const std::string& topic, std::size_t times = 1) const {
    return told(topic + " has a subscriber\n", times);
  }
  bool told(const std::string& words, std::size_t times) const {
    return eventually([&] { return count(bridge_->standard_error(), words) >= times; }, kPatience);
  }
  static std::size_t count(const std::string& text, const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(words, at)) != std::string::npos; ++at) ++found;
    return found;
  }
  std::string stop() {
    bridge_->signal(SIGTERM);
    EXPECT_EQ(bridge_->wait(kPatience), 0) << bridge_->standard_error();
    return bridge_->standard_error();
  }
  /// Sends twenty poses, numbered from `first`, to a subscriber that then leaves; it is the `nth` one of the test.
  void send_to_one_that_goes(int first, std::size_t nth) {
    const DdsReader poses("rt/azimuth/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_");
    ASSERT_TRUE(is_heard("/azimuth/pose", nth)) << bridge_->standard_error();
    for (int i = 0; i < 20; ++i) {
      const pose_cov_t pose = pose_number(first + i);
      lcm_.publish("AZIMUTH_POSE", &pose);
      std::this_thread::sleep_for(2ms);
    }
    EXPECT_EQ(heard(poses, 20).size(), 20u);
  }
  /// Waits until a reader has `count` messages and returns its messages.
  static std::vector<std::string> heard(const DdsReader& reader, std::size_t count) {
    eventually([&] { return reader.messages().size() >= count; }, kPatience);
    return reader.messages();
  }

  TemporaryFolder folder_;
  lcm::LCM lcm_{kUrl};
  std::unique_ptr<ChildProcess> bridge_;
};

TEST_F(Interop, AnotherDdsReceivesEachOfAThousandPoses) {
  const DdsReader poses("rt/azimuth/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_");
  start();
  ASSERT_TRUE(is_heard("/azimuth/pose")) << bridge_->standard_error();
  constexpr int kPoses = 1000;
  for (int i = 0; i < kPoses; ++i) {
    const pose_cov_t pose = pose_number(i);
    lcm_.publish("AZIMUTH_POSE", &pose);
    std::this_thread::sleep_for(2ms);
  }
  const std::vector<std::string> messages = heard(poses, kPoses);
  ASSERT_EQ(messages.size(), 1000u) << stop();
  for (int i = 0; i < kPoses; ++i) {
    const ReadPose pose = read_pose(messages[static_cast<std::size_t>(i)]);
    const pose_cov_t sent = pose_number(i);
    EXPECT_EQ(1'000'000 * std::int64_t{pose.sec} + pose.nanosec / 1000, sent.utime);
    EXPECT_EQ(pose.frame_id, "map");
    EXPECT_EQ(pose.position[0], sent.x_m);
    EXPECT_EQ(pose.position[1], sent.y_m);
    EXPECT_NEAR(2.0 * std::atan2(pose.orientation[2], pose.orientation[3]), sent.heading_rad, 1e-12);
    EXPECT_EQ(pose.covariance[0], sent.covariance[0]);
    EXPECT_EQ(pose.covariance[1], sent.covariance[1]);
    EXPECT_EQ(pose.covariance[35], sent.covariance[8]);
  }
  EXPECT_THAT(stop(), HasSubstr("1000 poses, 0 maps, 0 paths, 0 statuses\n"));
}

TEST_F(Interop, EveryTypeIsOnTheWireAsRecordingsHaveIt) {
  const DdsReader odometry("rt/odom", "nav_msgs::msg::dds_::Odometry_"),
      transforms("rt/tf", "tf2_msgs::msg::dds_::TFMessage_"), path("rt/azimuth/path", "nav_msgs::msg::dds_::Path_"),
      landmarks("rt/azimuth/landmarks", "visualization_msgs::msg::dds_::MarkerArray_"),
      diagnostics("rt/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_");
  start({"--domain", "0", "--base-frame", "robot"});
  for (const char* topic : {"/odom", "/tf", "/azimuth/path", "/azimuth/landmarks", "/diagnostics"})
    ASSERT_TRUE(is_heard(topic)) << bridge_->standard_error();

  ros::Frames frames;
  frames.base = "robot";
  const pose_cov_t pose = pose_number(3);
  lcm_.publish("AZIMUTH_POSE", &pose);
  const Stamp stamp = stamp_from_us(pose.utime);
  const Pose2 T_map_body{pose.x_m, pose.y_m, pose.heading_rad}, T_odom_body{pose.odom_x_m, 0.0, 0.0};
  ASSERT_EQ(heard(odometry, 1).size(), 1u);
  EXPECT_EQ(unfilled(odometry.messages()[0]),
            ros::ros2_bytes(ros::odometry_message(frames, std::nullopt, {stamp, T_odom_body})));
  ASSERT_EQ(heard(transforms, 1).size(), 1u);
  EXPECT_EQ(unfilled(transforms.messages()[0]),
            ros::ros2_bytes(ros::transform_message(frames, stamp, T_map_body, T_odom_body, true)));

  map_chunk_t map{};
  map.utime = kBegin_us;
  map.chunks = map.n = 1;
  map.landmarks.resize(1);
  map.landmarks[0].identity = 42;
  map.landmarks[0].covariance[0] = map.landmarks[0].covariance[2] = 0.25;
  map.landmarks[0].z_m = 2.0;
  map.landmarks[0].sigma_z_m = 0.5;
  lcm_.publish("AZIMUTH_MAP_CHUNK", &map);
  LandmarkEstimate landmark;
  landmark.identity = 42;
  landmark.covariance_m2.diagonal().setConstant(0.25);
  landmark.z_map_landmark_m = 2.0;
  landmark.sigma_z_m = 0.5;
  ASSERT_EQ(heard(landmarks, 1).size(), 1u);
  EXPECT_EQ(unfilled(landmarks.messages()[0]),
            ros::ros2_bytes(ros::landmark_markers(frames, stamp_from_us(kBegin_us), std::vector{landmark})));

  path_t way{};
  way.utime = kBegin_us;
  way.chunks = 1;
  way.n = 2;
  way.poses.resize(2);
  way.poses[1].utime = kBegin_us;
  way.poses[1].x_m = 7.0;
  lcm_.publish("AZIMUTH_PATH", &way);
  ASSERT_EQ(heard(path, 1).size(), 1u);
  const std::vector<PathPose> poses{{stamp_from_us(0), {}}, {stamp_from_us(kBegin_us), {7.0, 0.0, 0.0}}};
  EXPECT_EQ(unfilled(path.messages()[0]), ros::ros2_bytes(ros::path_message(frames, stamp_from_us(kBegin_us), poses)));

  status_t status{};
  status.reason = "no landmark yet";
  status.odometer = "running";
  lcm_.publish("AZIMUTH_STATUS", &status);
  ASSERT_EQ(heard(diagnostics, 1).size(), 1u);
  const std::string all = ros::ros2_bytes(ros::DiagnosticArray{{stamp, ""}, diagnostics_of(status)});
  constexpr std::size_t kBehindStamp = 4 + 8,
                        kBehindCount = 4 + 8 + 4 + 4 + 4;  // an empty string takes eight bytes with its padding
  EXPECT_EQ(diagnostics.messages()[0].substr(kBehindStamp, 5), all.substr(kBehindStamp, 5));
  EXPECT_EQ(diagnostics.messages()[0].substr(kBehindCount, all.size() - kBehindCount), all.substr(kBehindCount))
      << "then comes the bridge's own";
}

TEST_F(Interop, ASubscriberThatComesLateOrGoesDoesNoHarm) {
  start();
  ASSERT_TRUE(says("publishes in domain 0"));
  for (std::size_t round = 1; round <= 2; ++round) {
    send_to_one_that_goes(static_cast<int>(100 * round), round);
    EXPECT_TRUE(told("/azimuth/pose has no subscriber any more\n", round)) << bridge_->standard_error();
  }
  EXPECT_THAT(stop(), HasSubstr("40 poses"));
}

TEST_F(Interop, ADomainOfItsOwnIsNotHeardElsewhere) {
  const DdsReader here("rt/azimuth/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_", 7),
      elsewhere("rt/azimuth/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_", 0);
  start({"--domain", "7"});
  ASSERT_TRUE(is_heard("/azimuth/pose"));
  EXPECT_TRUE(here.is_matched());
  EXPECT_FALSE(elsewhere.is_matched());
}

/// The digest of all estimates that the daemon logs at its end.
std::string digest_in(const std::string& log) {
  constexpr std::string_view kDigest = "estimates, digest ";
  const std::size_t at = log.find(kDigest);
  return at == std::string::npos ? "" : log.substr(at + kDigest.size(), 16);
}

TEST_F(Interop, KilledItDoesNothingToTheDaemon) {
  const std::string run = write_run(small_recording(4.0), folder_.path() / "run").string();
  const TemporaryFolder other;
  ChildProcess alone({AZIMUTHD, "--play", run, "--speed", "max", "--lcm-url", "memq://"}, other.path());
  ASSERT_EQ(alone.wait(kPatience), 0) << alone.standard_error();
  const std::string digest = digest_in(alone.standard_error());
  ASSERT_EQ(digest.size(), 16u) << alone.standard_error();

  const DdsReader poses("rt/azimuth/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_");
  start();
  ASSERT_TRUE(is_heard("/azimuth/pose"));
  ChildProcess daemon({AZIMUTHD, "--play", run, "--speed", "2"}, other.path());
  ASSERT_GE(heard(poses, 10).size(), 10u) << bridge_->standard_error();
  bridge_->signal(SIGKILL);
  EXPECT_EQ(bridge_->wait(kPatience), 128 + SIGKILL);
  EXPECT_FALSE(daemon.wait(0ms)) << "it goes on";
  EXPECT_EQ(daemon.wait(kPatience), 0) << daemon.standard_error();
  EXPECT_EQ(digest_in(daemon.standard_error()), digest);
}

}  // namespace
}  // namespace azimuth::test
