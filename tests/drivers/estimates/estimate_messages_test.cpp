#include "drivers/estimates/estimate_messages.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

TEST(EstimateMessages, PosesComeBack) {
  Estimate estimate;
  estimate.stamp = stamp_from_us(1'234'567);
  estimate.sequence = 7;
  estimate.step = 3;
  estimate.T_map_body = {1.5, -2.5, 0.75};
  estimate.T_odom_body = {1.25, -2.75, 0.5};
  estimate.pose_covariance << 4.0, 0.5, 0.25, 0.5, 3.0, 0.125, 0.25, 0.125, 2.0;
  estimate.health = Health::degraded;
  estimate.predicted = true;
  const pose_cov_t message = to_message(estimate);
  EXPECT_EQ(message.utime, 1'234'567);
  EXPECT_EQ(message.seq, 7);
  EXPECT_EQ(message.step, 3);
  EXPECT_EQ(message.predicted, 1);
  EXPECT_EQ(map_pose_of(message).vector(), estimate.T_map_body.vector());
  EXPECT_EQ(odom_pose_of(message).vector(), estimate.T_odom_body.vector());
  EXPECT_EQ(covariance_of(message), estimate.pose_covariance);
  EXPECT_EQ(health_of(message.health), Health::degraded);
}

TEST(EstimateMessages, EachHealthHasACodeAndNoOtherCodeHasOne) {
  for (const Health health : {Health::starting, Health::tracking, Health::degraded, Health::lost})
    EXPECT_EQ(health_of(health_code(health)), health);
  EXPECT_EQ(health_of(-1), std::nullopt);
  EXPECT_EQ(health_of(4), std::nullopt);
}

LandmarkEstimate a_landmark() {
  LandmarkEstimate landmark;
  landmark.id = 12;
  landmark.identity = 5;
  landmark.p_map_landmark_m = {3.0, -4.0};
  landmark.covariance_m2 << 0.25, 0.125, 0.125, 0.5;
  return landmark;
}

TEST(EstimateMessages, LampsKeepTheirHeight) {
  LandmarkEstimate lamp = a_landmark();
  lamp.z_map_landmark_m = 6.5;
  lamp.sigma_z_m = 0.25;
  const LandmarkEstimate back = landmark_of(to_message(lamp));
  EXPECT_EQ(back.id, 12);
  EXPECT_EQ(back.identity, 5);
  EXPECT_EQ(back.p_map_landmark_m, lamp.p_map_landmark_m);
  EXPECT_EQ(back.covariance_m2, lamp.covariance_m2);
  EXPECT_EQ(back.z_map_landmark_m, 6.5);
  EXPECT_EQ(back.sigma_z_m, 0.25);
}

TEST(EstimateMessages, WhatIsFlatHasNoHeight) {
  const LandmarkEstimate back = landmark_of(to_message(a_landmark()));
  EXPECT_TRUE(std::isnan(back.z_map_landmark_m));
  EXPECT_TRUE(std::isnan(back.sigma_z_m));
}

TEST(EstimateMessages, PathsComeBack) {
  const PathPose pose{stamp_from_us(42), {1.0, 2.0, -0.5}};
  const PathPose back = path_pose_of(to_message(pose));
  EXPECT_EQ(back.stamp, pose.stamp);
  EXPECT_EQ(back.T_map_body.vector(), pose.T_map_body.vector());
}

}  // namespace
}  // namespace azimuth
