#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "slam/fastslam/cross_point.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/fastslam/symmetric.hpp"

namespace azimuth {

/// A landmark's place, and how well rays determine it.
struct LampFit {
  Eigen::Vector3d p_map;
  Symmetric3 covariance;
};

/// The point of least squares over all rays, from `first_guess` (SPEC II.8):
///   Sigma = [sum H_m^T (Q_l + H_x A H_x^T)^-1 H_m]^-1
/// with A, for each ray, the covariance that the pose has gathered between its viewpoint and now. Nothing when the rays
/// do not determine a point.
std::optional<LampFit> fit_point(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                                 const Eigen::Vector3d& first_guess);

/// What the fitted point is off by: the sum of `by_poses` times what the poses of the rays are off by, from the ray
/// `first_apart` on, and an error of its own.
struct LampFitError {
  std::array<Eigen::Matrix3d, LampCandidate::kMostSightings> by_poses;  ///< of the rays from `first_apart` on
  Symmetric3 own;
};
/// Poses have in common what they are off by, while the fit takes each for itself. The poses before `first_apart` are
/// taken for off by what that one is and by what the covariances that descend along the rays say of the way between.
LampFitError error_of_fit(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                          const Eigen::Vector3d& p_map, std::size_t first_apart);

}  // namespace azimuth
