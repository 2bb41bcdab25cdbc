#pragma once
#include <Eigen/Core>

#include "slam/ekf/joint_state.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

// Thread contract: reentrant.

/// What the filter believes: pose in the map frame, covariance of (x [m], y [m], heading [rad]).
struct PoseBelief {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance;  ///< within the map, as it would be if the odometer's scales had no error
  // Those errors, where the filter considers them.
  ByScales by_scales = ByScales::Zero();  ///< what they have made of the pose by now
  Eigen::Vector2d scale_variances = Eigen::Vector2d::Zero();

  /// As seen from outside: the map may be too large, and the path with it.
  Eigen::Matrix3d total_covariance() const {
    return covariance + by_scales * scale_variances.asDiagonal() * by_scales.transpose();
  }
};

/// Of the robot in a filter's state.
PoseBelief belief_of(const JointState& state);

/// What it will believe after `motion` and nothing else: P' = G P G^T + R Q R^T, D' = G D + B.
PoseBelief moved(const PoseBelief& belief, const Motion& motion);

/// What an estimate says of everything but the map.
void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement, Estimate& out);

}  // namespace azimuth
