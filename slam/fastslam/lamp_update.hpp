#pragma once
// Algorithm 4, lines 4 to 14: the update of a recognised landmark from the sampled pose (mathematics II.7).

#include <Eigen/Core>

#include "slam/fastslam/lamp_view.hpp"
#include "slam/fastslam/symmetric.hpp"

namespace azimuth {

/// Corrects a landmark by its detection from `x_t`:
///   Q_t = Q + H_m Sigma H_m^T,  K = Sigma H_m^T Q_t^-1,  mu += K wrap(z - h),  Sigma -= K Q_t K^T
void correct(const Viewpoint& x_t, const LampSighting& seen, Eigen::Vector3d& p_map, Symmetric3& Sigma);

/// ln N(z; h(mu, x_t), H_x R H_x^T + Q_t): the paper's factor of the particle's weight, with the residual at the
/// sampled pose. Must be called before the landmark is corrected.
double log_weight_paper(const Viewpoint& x_t, const Symmetric3& R, const LampSighting& seen,
                        const Eigen::Vector3d& p_map, const Symmetric3& Sigma);

}  // namespace azimuth
