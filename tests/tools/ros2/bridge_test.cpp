#include "tools/ros2/bridge/bridge.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <optional>
#include <vector>

#include "drivers/wire/channels.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

/// Stores the messages that the bridge sends.
class KeptOutput : public RosOutput {
 public:
  void send(const ros::PoseWithCovarianceStamped& message) override { poses.push_back(message); }
  void send(const ros::Odometry& message) override { odometry.push_back(message); }
  void send(const ros::TransformMessage& message) override { transforms.push_back(message); }
  void send(const ros::Path& message) override { paths.push_back(message); }
  void send(const ros::MarkerArray& message) override { maps.push_back(message); }
  void send(const ros::DiagnosticArray& message) override { diagnostics.push_back(message); }

  std::vector<ros::PoseWithCovarianceStamped> poses;
  std::vector<ros::Odometry> odometry;
  std::vector<ros::TransformMessage> transforms;
  std::vector<ros::Path> paths;
  std::vector<ros::MarkerArray> maps;
  std::vector<ros::DiagnosticArray> diagnostics;
};

pose_cov_t a_pose(std::int64_t ms, double x_m = 1.0) {
  pose_cov_t pose{};
  pose.utime = kNow_us + 1000 * ms;
  pose.x_m = x_m;
  pose.y_m = -2.0;
  pose.heading_rad = 0.5;
  pose.covariance[0] = 0.25;
  pose.odom_x_m = 10.0 + x_m;
  pose.health = pose_cov_t::HEALTH_TRACKING;
  return pose;
}

BridgeSettings with_transforms(TransformChoice choice) {
  BridgeSettings settings;
  settings.transforms = choice;
  return settings;
}

class BridgeTest : public testing::Test {
 protected:
  void make(BridgeSettings settings = {}) {
    bridge_.emplace(
        std::move(settings), output_, [this](const std::string& each) { told_.push_back(each); }, begin_);
  }
  /// Passes `message` to the bridge as a datagram of `sender` that arrives `ms` after the start.
  template <class Message>
  void hear(std::string_view channel, const Message& message, std::int64_t ms = 0, LcmPeer sender = 1) {
    std::vector<std::byte> data;
    encode(message, data);
    hear_bytes(channel, data, ms, sender);
  }
  void hear_bytes(std::string_view channel, Bytes data, std::int64_t ms = 0, LcmPeer sender = 1) {
    LcmPacket packet;
    packet.channel = channel;
    packet.payload = data;
    packet.size = static_cast<std::uint32_t>(data.size());
    bridge_->accept(packet, sender, {stamp_from_us(kNow_us + 1000 * ms), {}});
  }
  void turn(std::chrono::milliseconds after, const std::string& trouble = "") {
    bridge_->turn(begin_ + after, stamp_from_us(kNow_us) + after, trouble);
  }

  Bridge::Clock::time_point begin_ = Bridge::Clock::now();
  KeptOutput output_;
  std::vector<std::string> told_;
  std::optional<Bridge> bridge_;
};

TEST_F(BridgeTest, PassesOnEachPoseWithCovarianceAndTime) {
  make();
  hear(channel::kPose, a_pose(100), 100);
  ASSERT_EQ(output_.poses.size(), 1u);
  EXPECT_EQ(output_.poses[0].header.stamp, stamp_from_us(kNow_us + 100'000));
  EXPECT_EQ(output_.poses[0].header.frame_id, "map");
  EXPECT_EQ(output_.poses[0].pose.position.y, -2.0);
  EXPECT_EQ(output_.poses[0].covariance[0], 0.25);
  ASSERT_EQ(output_.odometry.size(), 1u);
  EXPECT_EQ(output_.odometry[0].pose.position.x, 11.0);
  ASSERT_EQ(output_.transforms.size(), 1u);
  EXPECT_EQ(output_.transforms[0].transforms.size(), 2u);
  EXPECT_EQ(bridge_->counts().poses, 1u);
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(BridgeTest, AStepOlderThanAPredictionSaysNothingNewOfOdometry) {
  make();
  hear(channel::kPose, a_pose(200), 200);
  hear(channel::kPose, a_pose(150), 210);
  hear(channel::kPose, a_pose(200), 215);
  hear(channel::kPose, a_pose(250), 250);
  EXPECT_EQ(output_.poses.size(), 4u);
  EXPECT_EQ(output_.odometry.size(), 2u);
  EXPECT_EQ(output_.transforms.size(), 2u);
  hear(channel::kPose, a_pose(-5000), 300);
  EXPECT_EQ(output_.odometry.size(), 3u) << "a recording that began again";
}

TEST_F(BridgeTest, LeavesTransformsToOthersWhereThatIsSaid) {
  make(with_transforms(TransformChoice::map_odom));
  hear(channel::kPose, a_pose(0));
  ASSERT_EQ(output_.transforms.size(), 1u);
  EXPECT_EQ(output_.transforms[0].transforms.size(), 1u);
  make(with_transforms(TransformChoice::none));
  hear(channel::kPose, a_pose(100));
  EXPECT_EQ(output_.transforms.size(), 1u);
  EXPECT_EQ(output_.odometry.size(), 2u);
}

TEST_F(BridgeTest, DrawsAMapWhenAllItsPiecesAreThere) {
  make();
  map_chunk_t piece{};
  piece.utime = kNow_us;
  piece.seq = 3;
  piece.chunks = 2;
  piece.n = 1;
  piece.landmarks.resize(1);
  piece.landmarks[0].identity = 5;
  hear(channel::kMapChunk, piece);
  EXPECT_THAT(output_.maps, IsEmpty());
  piece.chunk = 1;
  hear(channel::kMapChunk, piece);
  ASSERT_EQ(output_.maps.size(), 1u);
  EXPECT_EQ(output_.maps[0].markers.size(), 1 + 2 * 3u);
  EXPECT_EQ(output_.maps[0].markers[3].text, "5");
  EXPECT_EQ(bridge_->counts().maps, 1u);
}

TEST_F(BridgeTest, PassesOnThePathOfHindsight) {
  make();
  path_t piece{};
  piece.utime = kNow_us;
  piece.seq = 1;
  piece.chunks = 1;
  piece.n = 2;
  piece.poses.resize(2);
  piece.poses[0].utime = kNow_us - 5;
  piece.poses[1].utime = kNow_us;
  piece.poses[1].x_m = 4.0;
  hear(channel::kPath, piece);
  ASSERT_EQ(output_.paths.size(), 1u);
  EXPECT_EQ(output_.paths[0].poses[1].pose.position.x, 4.0);
  EXPECT_EQ(output_.paths[0].poses[0].header.stamp, stamp_from_us(kNow_us - 5));
}

TEST_F(BridgeTest, MakesDiagnosticsOfTheStatus) {
  make();
  status_t status{};
  status.health = pose_cov_t::HEALTH_DEGRADED;
  status.reason = "few landmarks";
  status.input_trouble = "odometry seems to be in millimetres";
  status.odometer = "running";
  status.robot_flags = status_t::ROBOT_EMERGENCY_STOP;
  status.battery_v = std::numeric_limits<double>::quiet_NaN();
  hear(channel::kStatus, status, 250);
  ASSERT_EQ(output_.diagnostics.size(), 1u);
  const ros::DiagnosticArray& message = output_.diagnostics[0];
  EXPECT_EQ(message.header.stamp, stamp_from_us(kNow_us + 250'000)) << "when it arrived";
  ASSERT_EQ(message.status.size(), 5u);
  EXPECT_EQ(message.status[0].message, "degraded: few landmarks");
  EXPECT_EQ(message.status[1].level, ros::DiagnosticStatus::kWarn);
  EXPECT_EQ(message.status[1].message, status.input_trouble);
  EXPECT_EQ(message.status[2].message, "emergency stop");
  EXPECT_EQ(message.status[3].level, ros::DiagnosticStatus::kOk);
  EXPECT_EQ(message.status[4].name, "azimuth: bridge to ROS 2");
  EXPECT_EQ(bridge_->counts().statuses, 1u);
}

TEST_F(BridgeTest, WarnsOfDevicesThatAreAway) {
  make();
  status_t status{};
  status.health = pose_cov_t::HEALTH_LOST;
  status.reason = "no odometry";
  status.odometer = "away: /dev/pioneer: open: No such file or directory";
  status.camera = "running (640x480)";
  status.battery_v = std::numeric_limits<double>::quiet_NaN();
  hear(channel::kStatus, status);
  ASSERT_EQ(output_.diagnostics.size(), 1u);
  const auto& told = output_.diagnostics[0].status;
  EXPECT_EQ(told[0].level, ros::DiagnosticStatus::kError);
  EXPECT_EQ(told[0].message, "lost: no odometry");
  EXPECT_EQ(told[2].level, ros::DiagnosticStatus::kWarn);
  EXPECT_EQ(told[2].message, "odometer: " + status.odometer);
}

TEST_F(BridgeTest, NamesAndCountsWhatCannotBePassedOn) {
  make();
  hear_bytes(channel::kPose, Bytes{});
  hear(channel::kStatus, a_pose(0));
  pose_cov_t wrong = a_pose(0);
  wrong.covariance[3] = std::nan("");
  hear(channel::kPose, wrong);
  hear("OTHERS", a_pose(0));
  EXPECT_THAT(output_.poses, IsEmpty());
  EXPECT_EQ(bridge_->counts().malformed.at("AZIMUTH_POSE"), 2u);
  EXPECT_EQ(bridge_->counts().malformed.at("AZIMUTH_STATUS"), 1u);
  EXPECT_EQ(bridge_->summary(),
            "0 poses, 0 maps, 0 paths, 0 statuses; not passed on: 2 malformed on AZIMUTH_POSE, 1 malformed on "
            "AZIMUTH_STATUS");
}

TEST_F(BridgeTest, LeavesOutTimesThatRos2DoesNotCount) {
  make();
  pose_cov_t late = a_pose(0);
  late.utime = 2'147'483'648'000'000;
  hear(channel::kPose, late);
  hear(channel::kPose, late);
  EXPECT_THAT(output_.poses, IsEmpty());
  EXPECT_EQ(bridge_->counts().beyond_ros, 2u);
  EXPECT_THAT(told_, ElementsAre(HasSubstr("stamped 2147483648 s since 1970")));
}

TEST_F(BridgeTest, SaysOnceThatPosesAreOfAnotherClock) {
  make();
  pose_cov_t recorded = a_pose(0);
  recorded.utime = 5'000'000;
  hear(channel::kPose, recorded);
  hear(channel::kPose, recorded);
  EXPECT_EQ(output_.poses.size(), 2u) << "shown all the same";
  EXPECT_THAT(told_, ElementsAre(HasSubstr("does azimuthd play a recording, or is a clock wrong?")));
}

TEST_F(BridgeTest, SaysOnceThatNothingIsHeard) {
  BridgeSettings settings;
  settings.channel_prefix = "R1_";
  make(settings);
  turn(4900ms);
  EXPECT_THAT(told_, IsEmpty());
  turn(5000ms);
  turn(5100ms);
  turn(6000ms);
  EXPECT_THAT(told_, ElementsAre("no pose on R1_AZIMUTH_POSE of udpm://239.255.76.67:7667?ttl=0 for 5 s: does azimuthd "
                                 "run, with this daemon.lcm.url and daemon.lcm.channel_prefix?"));
  ASSERT_EQ(output_.diagnostics.size(), 2u) << "once a second";
  EXPECT_EQ(output_.diagnostics[0].status.at(0).level, ros::DiagnosticStatus::kStale);
  hear("R1_AZIMUTH_POSE", a_pose(6100), 6100);
  turn(6200ms);
  EXPECT_EQ(told_.back(), "poses come again");
  turn(12000ms);
  EXPECT_EQ(told_.size(), 3u) << "it is silent anew";
}

TEST_F(BridgeTest, SaysWhenTheDaemonRunsWithoutAPose) {
  make();
  status_t status{};
  status.odometer = "/dev/pioneer: No such file or directory";
  hear(channel::kStatus, status, 4500);
  turn(4600ms);
  turn(5000ms);
  EXPECT_THAT(told_, ElementsAre("azimuthd runs, but sends no pose (odometer: /dev/pioneer: No such file or directory; "
                                 "camera: none)"));
}

TEST_F(BridgeTest, SaysWhyNothingCanBeHeard) {
  make();
  turn(5000ms, "239.255.76.67:7667: join the group: No such device");
  EXPECT_THAT(told_, ElementsAre("no pose can be heard: 239.255.76.67:7667: join the group: No such device"));
}

TEST_F(BridgeTest, ListensToOneDaemonAtATime) {
  make();
  hear(channel::kPose, a_pose(0), 0, 1);
  hear(channel::kPose, a_pose(10), 10, 2);
  EXPECT_THAT(told_, IsEmpty()) << "it may have been started anew";
  hear(channel::kPose, a_pose(20), 20, 1);
  hear(channel::kPose, a_pose(30), 30, 2);
  hear(channel::kPose, a_pose(40), 40, 1);
  EXPECT_EQ(output_.poses.size(), 3u);
  EXPECT_EQ(bridge_->counts().other_senders, 2u);
  EXPECT_THAT(told_, ElementsAre(HasSubstr("a second process sends on the same channels")));
}

TEST_F(BridgeTest, ListensToADaemonThatIsStartedAnew) {
  make();
  hear(channel::kPose, a_pose(0), 0, 1);
  hear(channel::kPose, a_pose(100), 100, 2);
  hear(channel::kPose, a_pose(600), 600, 2);
  hear(channel::kPose, a_pose(700), 700, 2);
  EXPECT_EQ(output_.poses.size(), 3u);
  EXPECT_THAT(told_, IsEmpty());
}

}  // namespace
}  // namespace azimuth::test
