#include "slam/fastslam/ray_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>

namespace azimuth {
namespace {

constexpr int kMaxIterations = 10;
constexpr double kConverged_m = 1e-6;
constexpr double kFarthestStep_m = 10.0;

/// A drawn pose has the error of the proposal's mean plus that of the draw: twice the proposal's covariance.
constexpr double kPathErrors = 2.0;

struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

NormalEquations linearise(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                          const Eigen::Vector3d& p_map) {
  NormalEquations equations;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const LampView v = view(rays[i].from, p_map);
    const Eigen::Matrix2d weight = (rays[i].seen->covariance + v.of_pose(pose_covariances[i])).matrix().inverse();
    const Eigen::Matrix<double, 2, 3> H = v.H_m();
    equations.information += H.transpose() * weight * H;
    equations.right += H.transpose() * (weight * innovation(v, rays[i].from, *rays[i].seen));
  }
  return equations;
}

}  // namespace

std::optional<LampFit> fit_point(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                                 const Eigen::Vector3d& first_guess) {
  assert(rays.size() == pose_covariances.size());
  Eigen::Vector3d p_map = first_guess;
  for (int i = 0; i < kMaxIterations; ++i) {
    const NormalEquations equations = linearise(rays, pose_covariances, p_map);
    const Eigen::LLT<Eigen::Matrix3d> factor(equations.information);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Eigen::Vector3d step = factor.solve(equations.right);
    if (!(step.norm() < kFarthestStep_m)) return std::nullopt;
    p_map += step;
    if (step.norm() < kConverged_m) return LampFit{p_map, Symmetric3::of(factor.solve(Eigen::Matrix3d::Identity()))};
  }
  return std::nullopt;
}

/* With A the inverse of the information and W_i the weights, the error of the point is A sum_i H_i^T W_i (v_i - H_x,i
 * e_i). Let e be the error of the pose `first_apart`. The pose of an earlier ray i has the error e_i = T_i e +
 * sum_{k >= i} T_ik d_k, where d_k is the drift from ray k to the next and T holds the lever arms of the headings:
 *   own = A [sum_i H_i^T W_i Q_i W_i H_i + sum_k F_k D_k F_k^T] A,  F_k = sum_{i <= k} H_i^T W_i H_x,i T_ik
 */
LampFitError error_of_fit(std::span<const Ray> rays, std::span<const Symmetric3> pose_covariances,
                          const Eigen::Vector3d& p_map, std::size_t first_apart) {
  LampFitError error;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero(), own = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const LampView v = view(rays[i].from, p_map);
    const Eigen::Matrix2d Q = rays[i].seen->covariance.matrix();
    const Eigen::Matrix2d W = (rays[i].seen->covariance + v.of_pose(pose_covariances[i])).matrix().inverse();
    const Eigen::Matrix<double, 3, 2> HtW = v.H_m().transpose() * W;
    information += HtW * v.H_m();
    own += HtW * Q * HtW.transpose();
    F += HtW * v.H_x();
    if (i >= first_apart) {
      error.by_poses[i] = F;
      F.setZero();
      continue;
    }
    const Viewpoint &here = rays[i].from, &next = rays[i + 1].from;
    F.col(2) += F * Eigen::Vector3d(next.y_m - here.y_m, here.x_m - next.x_m, 0.0);
    own += F * kPathErrors * (pose_covariances[i] - pose_covariances[i + 1]).matrix() * F.transpose();
  }
  const Eigen::Matrix3d A = information.inverse();
  for (std::size_t i = first_apart; i < rays.size(); ++i) error.by_poses[i] = -A * error.by_poses[i];
  error.own = Symmetric3::of(A * own * A);
  return error;
}

}  // namespace azimuth
