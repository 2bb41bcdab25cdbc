#include "slam/fastslam/ray_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>

namespace azimuth {
namespace {

constexpr int kMaxIterations = 10;
constexpr double kConverged_m = 1e-6;
constexpr double kFarthestStep_m = 10.0;

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

}  // namespace azimuth
