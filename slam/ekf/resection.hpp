#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A direction, from the robot's heading, to a landmark of the map.
struct DirectionTo {
  Eigen::Vector2d p_map_landmark_m;
  double azimuth_rad;
};

/// The pose from which landmarks are seen in given directions, found without a prior pose.
struct Resection {
  Pose2 T_map_body;
  Eigen::Matrix3d covariance;     ///< Covariance of (x, y, heading), due to bearings and landmarks
  Eigen::Matrix3Xd by_landmarks;  ///< d(pose) / d(x, y of each landmark)
  Eigen::Matrix3d noise;          ///< The part of `covariance` due to the bearings
  double chi2;                    ///< Chi-square of the residuals; degrees of freedom: directions - 3
  double rival_chi2 = std::numeric_limits<double>::infinity();  ///< Chi-square of the best distinct other pose
};

/// Least squares over all directions, weighted by the noise of the bearings and the joint covariance of the landmarks'
/// positions (2 rows for each, in their order), from starts on a grid over the map and around it. Needs at least 3
/// directions. Nothing when no start converges, or a landmark is nearer than `min_distance_m`.
///
/// Not for every step: the call takes a fraction of a millisecond and allocates.
std::optional<Resection> resect(std::span<const DirectionTo> directions, const Eigen::MatrixXd& landmark_covariance_m2,
                                double variance_rad2, double min_distance_m);

}  // namespace azimuth
