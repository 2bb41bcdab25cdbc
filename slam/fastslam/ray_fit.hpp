#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "slam/fastslam/cross_point.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/fastslam/symmetric.hpp"

namespace azimuth {

/// A landmark's position and its covariance by the fit.
struct LampFit {
  Eigen::Vector3d p_map;
  Symmetric3 covariance;
};

/// The least-squares point of all rays, starting from `first_guess` (mathematics II.8):
///   Sigma = [sum H_m^T (Q_l + H_x A H_x^T)^-1 H_m]^-1
/// where A is, for each ray, the pose covariance gathered between its viewpoint and now. Returns nullopt if the rays do
/// not determine a point.
std::optional<LampFit> fit_point(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                                 const Eigen::Vector3d& first_guess);

/// The error of the fitted point is a sum over the rays from `first_apart` on, of `by_poses` times the error of the
/// ray's pose, plus an independent error with the covariance `own`.
struct LampFitError {
  std::array<Eigen::Matrix3d, LampCandidate::kMostSightings> by_poses;  ///< Of the rays from `first_apart` on
  Symmetric3 own;
};
/// The fit takes the errors of the poses as independent, although they share errors; this function corrects for that.
/// The error of a pose before `first_apart` is modelled as the error of the pose `first_apart` plus the drift between
/// the two, which follows from the decrease of `pose_covariances` along the rays.
LampFitError error_of_fit(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                          const Eigen::Vector3d& p_map, std::size_t first_apart);

}  // namespace azimuth
