#include "drivers/ros/make_messages.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace azimuth::ros {
namespace {

constexpr Stamp kNow = stamp_from_us(1'700'000'000'250'000);

double heading(const Quaternion& q) { return 2.0 * std::atan2(q.z, q.w); }

TimedPose at(std::int64_t ms, const Pose2& pose) { return {kNow + Duration(1000 * ms), pose}; }

TEST(PoseMessage, PutsThePlaneIntoSpace) {
  Eigen::Matrix3d P;
  P << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  const PoseWithCovarianceStamped message = pose_message({}, kNow, {1.5, -2.5, 0.5}, P);
  EXPECT_EQ(message.header.stamp, kNow);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.pose.position.x, 1.5);
  EXPECT_EQ(message.pose.position.y, -2.5);
  EXPECT_EQ(message.pose.position.z, 0.0);
  EXPECT_NEAR(heading(message.pose.orientation), 0.5, 1e-15);
  EXPECT_EQ(message.covariance[0], 1.0);
  EXPECT_EQ(message.covariance[1], 2.0);
  EXPECT_EQ(message.covariance[5], 3.0) << "x with the rotation about z";
  EXPECT_EQ(message.covariance[6], 2.0);
  EXPECT_EQ(message.covariance[7], 5.0);
  EXPECT_EQ(message.covariance[11], 6.0);
  EXPECT_EQ(message.covariance[30], 3.0);
  EXPECT_EQ(message.covariance[35], 9.0);
  double all = 0.0;
  for (const double value : message.covariance) all += value;
  EXPECT_EQ(all, 1 + 5 + 9 + 2 * (2 + 3 + 6)) << "nothing else is uncertain";
}

TEST(Velocity, IsThatOfTheArcBetweenTwoPoses) {
  const double radius_m = 2.0, angle_rad = 0.2;
  const Pose2 begin{3.0, 4.0, 1.0};
  const Pose2 arc{radius_m * std::sin(angle_rad), radius_m * (1.0 - std::cos(angle_rad)), angle_rad};
  const Twist twist = velocity_between(at(0, begin), at(100, begin * arc));
  EXPECT_NEAR(twist.angular.z, 2.0, 1e-9);
  EXPECT_NEAR(twist.linear.x, 4.0, 0.01) << "the chord is a little shorter";
  EXPECT_NEAR(twist.linear.y, 0.0, 1e-9) << "it drives straight ahead";
}

TEST(Velocity, IsNotKnownAcrossAGapOrBackwards) {
  const Pose2 begin, end{1.0, 0.0, 0.0};
  EXPECT_EQ(velocity_between(at(0, begin), at(1001, end)).linear.x, 0.0);
  EXPECT_EQ(velocity_between(at(0, begin), at(0, end)).linear.x, 0.0);
  EXPECT_EQ(velocity_between(at(10, begin), at(0, end)).linear.x, 0.0);
  EXPECT_EQ(velocity_between(at(0, begin), at(1000, end)).linear.x, 1.0);
}

TEST(OdometryMessage, HasTheOdometersFrameAndTheRobots) {
  const Odometry message = odometry_message({}, at(0, {1, 2, 0}), at(500, {2, 2, 0}));
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_EQ(message.pose.position.x, 2.0);
  EXPECT_EQ(message.twist.linear.x, 2.0);
  EXPECT_EQ(odometry_message({}, std::nullopt, at(0, {1, 2, 0})).twist.linear.x, 0.0);
}

TEST(TransformMessage, LeadsFromTheMapToTheRobot) {
  const Pose2 T_map_body{1.0, 2.0, 0.7}, T_odom_body{-3.0, 0.5, -2.9};
  const TransformMessage message = transform_message({}, kNow, T_map_body, T_odom_body, true);
  ASSERT_EQ(message.transforms.size(), 2u);
  EXPECT_EQ(message.transforms[0].header.frame_id, "map");
  EXPECT_EQ(message.transforms[0].child_frame_id, "odom");
  EXPECT_EQ(message.transforms[1].header.frame_id, "odom");
  EXPECT_EQ(message.transforms[1].child_frame_id, "base_link");
  const auto planar = [](const Pose& pose) {
    return Pose2{pose.position.x, pose.position.y, heading(pose.orientation)};
  };
  const Pose2 product = planar(message.transforms[0].transform) * planar(message.transforms[1].transform);
  EXPECT_NEAR(product.x_m, T_map_body.x_m, 1e-12);
  EXPECT_NEAR(product.y_m, T_map_body.y_m, 1e-12);
  EXPECT_NEAR(wrap(product.heading_rad - T_map_body.heading_rad), 0.0, 1e-12);
  EXPECT_EQ(transform_message({}, kNow, T_map_body, T_odom_body, false).transforms.size(), 1u);
}

TEST(LandmarkMarkers, DrawPlaceUncertaintyAndName) {
  LandmarkEstimate named, nameless;
  named.id = 7;
  named.identity = 42;
  named.p_map_landmark_m = {1.0, 2.0};
  named.covariance_m2 << 0.05, 0.04, 0.04, 0.05;
  named.z_map_landmark_m = 3.0;
  named.sigma_z_m = 0.5;
  nameless.id = 8;
  const std::vector<LandmarkEstimate> landmarks{named, nameless};
  const MarkerArray message = landmark_markers({}, kNow, landmarks);
  ASSERT_EQ(message.markers.size(), 7u);
  EXPECT_EQ(message.markers[0].action, Marker::kDeleteAll);
  EXPECT_EQ(message.markers[0].header.frame_id, "map");
  EXPECT_EQ(message.markers[1].pose.position.z, 3.0);
  const Marker& ellipse = message.markers[2];
  EXPECT_NEAR(ellipse.scale.x, 4.0 * 0.3, 1e-12) << "the larger axis first";
  EXPECT_NEAR(ellipse.scale.y, 4.0 * 0.1, 1e-12);
  EXPECT_EQ(ellipse.scale.z, 2.0);
  EXPECT_NEAR(std::tan(heading(ellipse.pose.orientation)), 1.0, 1e-9);
  EXPECT_EQ(message.markers[3].text, "42");
  EXPECT_EQ(message.markers[6].text, "#8");
  EXPECT_EQ(message.markers[4].pose.position.z, 0.0);
  for (const Marker& marker : message.markers) {
    EXPECT_EQ(marker.action == Marker::kDeleteAll || marker.scale.z > 0.0, true);
    EXPECT_NEAR(std::hypot(marker.pose.orientation.z, marker.pose.orientation.w), 1.0, 1e-12);
  }
}

TEST(LandmarkMarkers, OfAnEmptyMapDeleteWhatWasThere) {
  ASSERT_EQ(landmark_markers({}, kNow, {}).markers.size(), 1u);
  EXPECT_EQ(landmark_markers({}, kNow, {}).markers[0].action, Marker::kDeleteAll);
}

TEST(HealthStatus, SaysHowFarThePoseCanBeReliedOn) {
  EXPECT_EQ(health_status(Health::tracking, "").level, DiagnosticStatus::kOk);
  EXPECT_EQ(health_status(Health::starting, "").level, DiagnosticStatus::kWarn);
  EXPECT_EQ(health_status(Health::degraded, "few").level, DiagnosticStatus::kWarn);
  EXPECT_EQ(health_status(Health::lost, "").level, DiagnosticStatus::kError);
  EXPECT_EQ(health_status(Health::degraded, "few").message, "degraded: few");
  EXPECT_EQ(health_status(Health::tracking, "").message, "tracking");
}

}  // namespace
}  // namespace azimuth::ros
