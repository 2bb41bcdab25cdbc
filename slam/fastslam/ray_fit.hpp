#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "slam/fastslam/cross_point.hpp"
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

}  // namespace azimuth
