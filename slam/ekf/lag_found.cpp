#include "slam/ekf/lag_found.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace azimuth {

std::optional<LagFound> lag_found(const JointState& state) {
  constexpr int kLag = 2;
  const JointState::Told& told = state.told_of_considered();
  Eigen::Matrix3d information = told.information;
  for (Index scale = 0; scale < kLag; ++scale) {
    const double variance = state.considered()(scale);
    if (variance <= 0.0) {  // exact: no part in it
      information.row(scale).setZero();
      information.col(scale).setZero();
    }
    information(scale, scale) += variance > 0.0 ? 1.0 / variance : 1.0;
  }
  const Eigen::LLT<Eigen::Matrix3d> factor(information);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Eigen::Vector3d pull = told.pull;
  for (Index scale = 0; scale < kLag; ++scale)
    if (state.considered()(scale) <= 0.0) pull(scale) = 0.0;
  const double variance_s2 = factor.solve(Eigen::Vector3d::Unit(kLag))(kLag);
  if (!(variance_s2 > 0.0) || !std::isfinite(variance_s2)) return std::nullopt;
  return LagFound{factor.solve(pull)(kLag), std::sqrt(variance_s2)};
}

}  // namespace azimuth
