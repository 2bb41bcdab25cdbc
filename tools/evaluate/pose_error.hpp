#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/evaluate/statistics.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// An estimated pose and the true pose at the same instant.
struct PosePair {
  std::size_t index = 0;  ///< index of the estimate
  Pose2 estimated;        ///< in any frame fixed to the ground
  Pose2 T_world_body;
};

/// Pairs each estimate with the true pose at its instant. Estimates without truth (see pose_at()) are left out.
std::vector<PosePair> pair_with_truth(std::span<const StampedPose> estimated, std::span<const StampedPose> truth);

/// The rigid motion T_world_estimated that minimises the squared distances between estimated and true positions.
/// Nothing without pairs.
std::optional<Pose2> alignment(std::span<const PosePair> pairs);

/// Errors after alignment, for each pair in order.
struct PoseErrors {
  std::vector<double> position_m;
  std::vector<double> heading_rad;  ///< magnitudes
};
PoseErrors pose_errors(std::span<const PosePair> pairs, const Pose2& T_world_estimated);

/// Error of a pose and the covariance that the estimate states for it.
struct RelativeError {
  std::size_t index = 0;                                 ///< index of the estimate
  Eigen::Vector3d error = Eigen::Vector3d::Zero();       ///< (x [m], y [m], heading [rad])
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of `error`
};

/// Errors of the poses relative to the first pair, for each pair except the first. Estimate and truth are both
/// expressed in the frame of the first pair. No alignment is needed, which would depend on the errors themselves.
std::vector<RelativeError> relative_errors(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates);

/// Position error as a fraction of the limit that the estimate's covariance sets. 1 is the limit.
struct TwoSigmaShare {
  /// Relative to the ellipse that contains 95 % of all errors if the covariance is correct.
  double of_ellipse = 0.0;
  /// Relative to two standard deviations in the direction of the error. This limit is stricter: if the covariance is
  /// correct, it contains 86 % of all errors for a circular covariance and 95 % for a very elongated one.
  double of_direction = 0.0;
};
/// Nothing if the covariance of (x, y) is singular.
std::optional<TwoSigmaShare> two_sigma_share(const RelativeError& error);

/// Normalised estimation error squared (NEES) of (x, y, heading). Its mean is 3 if the covariances are correct. Nothing
/// if the covariance of `estimate` is singular.
std::optional<double> normalised_squared(const RelativeError& error, const EstimateRecord& estimate);

/// Average normalised estimation error squared (ANEES) of (x, y, heading). It is 3 if the covariances are correct.
struct Consistency {
  double anees = kNotMeasured;
  std::size_t evaluated = 0;
  std::size_t singular = 0;  ///< estimates left out because their covariance is singular
};

/// Computed from relative_errors().
Consistency consistency(std::span<const PosePair> pairs, std::span<const EstimateRecord> estimates);

}  // namespace azimuth
