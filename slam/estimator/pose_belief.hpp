#pragma once
#include <Eigen/Core>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

// Thread contract: reentrant.

/// What the filter believes: pose in the map frame, covariance of (x [m], y [m], heading [rad]).
struct PoseBelief {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance;
};

/// What it will believe after `motion` and nothing else: P' = G P G^T + R Q R^T.
PoseBelief moved(const PoseBelief& belief, const Motion& motion);

/// What an estimate says of everything but the map.
void write_belief(const PoseBelief& belief, const AssociationCounts& counts, const Judgement& judgement, Estimate& out);

}  // namespace azimuth
