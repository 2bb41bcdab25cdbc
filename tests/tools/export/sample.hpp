#pragma once
// A sample estimate for the tests of the export.

#include <cmath>
#include <cstdint>

#include "tools/export/estimated.hpp"

namespace azimuth::test {

inline constexpr std::int64_t kSampleBegin_us = 1'700'000'000'000'000;

/// Pose `i` of a drive round a circle, with ten poses per second. The odometry frame differs from the map frame, and
/// the health changes at 3.0 s and at 5.5 s.
inline EstimatedPose sample_pose(std::int64_t i) {
  const double angle = 0.05 * static_cast<double>(i);
  EstimatedPose pose;
  pose.stamp = stamp_from_us(kSampleBegin_us + 100'000 * i);
  pose.T_map_body = {2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle), wrap(angle)};
  pose.covariance << 0.04, 0.001, 0.002, 0.001, 0.09, -0.003, 0.002, -0.003, 0.01;
  pose.T_odom_body = Pose2{-1.0, 3.0, 0.25} * pose.T_map_body;
  pose.health = i < 30 ? Health::starting : i < 55 ? Health::tracking : Health::degraded;
  pose.reason = i < 30 ? "no landmark yet" : i < 55 ? "" : "few, if any, landmarks";
  return pose;
}

/// The drive with three landmarks: one with an identity, one with a height, one with a large covariance.
inline Estimated sample(std::int64_t poses = 80) {
  Estimated estimated;
  estimated.run = "sample";
  for (std::int64_t i = 0; i < poses; ++i) estimated.poses.push_back(sample_pose(i));
  for (std::int64_t id = 0; id < 3; ++id) {
    LandmarkEstimate landmark;
    landmark.id = 10 + id;
    landmark.p_map_landmark_m = {1.5 * static_cast<double>(id), -2.0};
    landmark.covariance_m2 << 0.05, 0.04, 0.04, 0.05;
    estimated.landmarks.push_back(landmark);
  }
  estimated.landmarks[0].identity = 42;
  estimated.landmarks[1].z_map_landmark_m = 2.5;
  estimated.landmarks[1].sigma_z_m = 0.25;
  estimated.landmarks[2].covariance_m2 *= 1e4;
  return estimated;
}

}  // namespace azimuth::test
