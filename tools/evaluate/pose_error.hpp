#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/evaluate/statistics.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// An estimated pose beside the true one of the same instant.
struct PosePair {
  std::size_t index = 0;  ///< of the estimate
  Pose2 estimated;        ///< in any frame fixed to the ground
  Pose2 T_world_body;
};

/// Pairs every estimate that has truth at its instant (see pose_at()).
std::vector<PosePair> pair_with_truth(std::span<const StampedPose> estimated, std::span<const StampedPose> truth);

/// The one rigid motion that brings the estimated positions closest to the true ones: T_world_estimated. Nothing
/// without pairs.
std::optional<Pose2> alignment(std::span<const PosePair> pairs);

/// Errors after that motion, for each pair in order.
struct PoseErrors {
  std::vector<double> position_m;
  std::vector<double> heading_rad;  ///< magnitudes
};
PoseErrors pose_errors(std::span<const PosePair> pairs, const Pose2& T_world_estimated);

/// How far a pose is off, beside what its estimate says of that.
struct RelativeError {
  std::size_t index = 0;                                 ///< of the estimate
  Eigen::Vector3d error = Eigen::Vector3d::Zero();       ///< (x [m], y [m], heading [rad])
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of these
};

/// Estimate and truth are both taken relative to the first pair, in whose frame errors and covariances are, so no
/// alignment, which would use the errors to be judged, comes between. One for each pair but the first.
std::vector<RelativeError> relative_errors(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates);

/// How much of what an estimate allows its position's error takes, 1 being the limit.
struct TwoSigmaShare {
  /// Against the ellipse that holds 95 % of all errors if the covariance is right.
  double of_ellipse = 0.0;
  /// Against two standard deviations in the direction of the error, which is stricter: a round covariance that is right
  /// keeps 86 % of all errors within these, a flat one 95 %.
  double of_direction = 0.0;
};
/// Nothing where the covariance of (x, y) cannot be inverted.
std::optional<TwoSigmaShare> two_sigma_share(const RelativeError& error);

/// The error squared in its own standard deviations, summed over (x, y, heading): 3 on the average where the estimate's
/// covariance is honest. Nothing where that, which is of `estimate`, cannot be inverted.
std::optional<double> normalised_squared(const RelativeError& error, const EstimateRecord& estimate);

/// Average normalised estimation error squared of (x, y, heading), 3 when the covariances are honest.
struct Consistency {
  double anees = kNotMeasured;
  std::size_t evaluated = 0;
  std::size_t singular = 0;  ///< left out: a covariance that cannot be inverted says nothing about its error
};

/// Over relative_errors().
Consistency consistency(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates);

}  // namespace azimuth
