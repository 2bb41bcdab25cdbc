#pragma once
// What recognised landmarks change. Algorithm 3: the pose of one particle given the landmarks that it recognises
// (mathematics II.6). Algorithm 4, lines 4 to 14: a recognised landmark, updated from the sampled pose (mathematics
// II.7).

#include <Eigen/Core>

#include "slam/fastslam/lamp_view.hpp"
#include "slam/fastslam/symmetric.hpp"

namespace azimuth {

/// N(mu_j, Sigma_j), obtained from N(x_hat, R) by one landmark after the other. The gain form needs no inverse of R:
///   S = H_x Sigma_{j-1} H_x^T + Q_j,  K = Sigma_{j-1} H_x^T S^-1,
///   mu_j = mu_{j-1} + K nu,  Sigma_j = Sigma_{j-1} - K S K^T
///
/// Thread contract: reentrant.
class PoseProposal {
 public:
  PoseProposal(const Eigen::Vector3d& x_hat, const Symmetric3& R) : x_hat_(x_hat), covariance_(R) {}

  /// Adds a landmark by its view and innovation at x_hat. The innovation is transferred linearly to mu_{j-1}: nu - H_x
  /// (mu_{j-1} - x_hat). `Q` is Q_l + H_m Sigma H_m^T.
  void add(const LampView& view_from_x_hat, const Eigen::Vector2d& innovation, const Symmetric2& Q);

  /// Adds a landmark with the model linearised at mu_{j-1}; `Sigma` is the landmark's covariance.
  void add_relinearised(const Eigen::Vector3d& p_map, const Symmetric3& Sigma, const LampSighting& seen,
                        double height_m);

  Eigen::Vector3d mean() const {
    const Eigen::Vector3d x = x_hat_ + step_;
    return {x.x(), x.y(), wrap(x.z())};
  }
  const Symmetric3& covariance() const { return covariance_; }

  /// ln of the joint density of all innovations added, N(nu; 0, H R H^T + blkdiag(Q_j)). It is exact if all were added
  /// at x_hat.
  double log_likelihood() const { return log_likelihood_; }

 private:
  void correct(const LampView& view, const Eigen::Vector2d& innovation, const Symmetric2& Q);

  Eigen::Vector3d x_hat_;
  Eigen::Vector3d step_ = Eigen::Vector3d::Zero();  // mu_j - x_hat
  Symmetric3 covariance_;
  double log_likelihood_ = 0.0;
};

/// Corrects a landmark by its detection from `x_t`:
///   Q_t = Q + H_m Sigma H_m^T,  K = Sigma H_m^T Q_t^-1,  mu += K wrap(z - h),  Sigma -= K Q_t K^T
void correct(const Viewpoint& x_t, const LampSighting& seen, Eigen::Vector3d& p_map, Symmetric3& Sigma);

/// ln N(z; h(mu, x_t), H_x R H_x^T + Q_t): the paper's factor of the particle's weight, with the residual at the
/// sampled pose. Must be called before the landmark is corrected.
double log_weight_paper(const Viewpoint& x_t, const Symmetric3& R, const LampSighting& seen,
                        const Eigen::Vector3d& p_map, const Symmetric3& Sigma);

}  // namespace azimuth
