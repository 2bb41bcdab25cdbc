#pragma once
// The noise of bearings and motions, and the uncertainty of the rig itself, as the rig gives them. Thread contract:
// reentrant.

#include <cmath>

#include "slam/camera/camera_rig.hpp"
#include "slam/ekf/joint_state.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The standard deviation of one bearing: the one that the bearing carries, or the rig's if it carries none.
inline double sigma_rad(const Bearing& bearing, const CameraRig& rig) {
  return std::isnan(bearing.sigma_rad) ? rig.sigma_bearing_rad : bearing.sigma_rad;
}

/// The motion with the rig's minimum noise added, which prevents overconfidence: otherwise a straight drive would keep
/// the heading exactly (mathematics I.3). No noise is added while the robot stands still.
inline Motion with_floors(Motion motion, const OdometryRig& rig) {
  if (!motion.moved()) return motion;
  const double distance_m2 = rig.floor_distance_m * rig.floor_distance_m;
  const double rotation_rad2 = rig.floor_rotation_rad * rig.floor_rotation_rad;
  motion.covariance.diagonal() += Eigen::Vector3d(distance_m2, distance_m2, rotation_rad2);
  return motion;
}

/// Standard deviations of the odometer's scales that the rig leaves unknown: (distance, turn).
inline Eigen::Vector2d sigma_scales(const OdometryRig& rig) { return {rig.sigma_scale_distance, rig.sigma_scale_turn}; }

/// Standard deviations of all rig errors that a filter considers.
inline Considered sigma_considered(const Rig& rig) {
  Considered sigma;
  sigma(considered::scale_distance) = rig.odometry.sigma_scale_distance;
  sigma(considered::scale_turn) = rig.odometry.sigma_scale_turn;
  sigma(considered::lag) = rig.odometry.sigma_lag_s;
  sigma(considered::drift) = rig.odometry.sigma_drift_rad_per_m;
  sigma(considered::yaw) = rig.camera.sigma_yaw_rad;
  sigma.segment<2>(considered::camera).setConstant(rig.camera.sigma_position_m);
  return sigma;
}

}  // namespace azimuth
