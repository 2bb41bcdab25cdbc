#pragma once
// Algorithm 2: the likelihood of a detection for a landmark (mathematics II.4).

#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

/// A landmark's predicted detection from a particle's x_hat.
struct ExpectedLamp {
  LampView view;
  Symmetric2 of_point;    ///< H_m Sigma H_m^T
  Symmetric2 of_pose;     ///< H_x R H_x^T
  double trace_m2 = 0.0;  ///< Trace of Sigma, a measure of the landmark's uncertainty
  int slot = 0;           ///< Index of the landmark in the particle's map
};
ExpectedLamp expect(const Viewpoint& x_hat, const Symmetric3& R, const Eigen::Vector3d& p_map, const Symmetric3& Sigma);

/// ln N(z; zbar, S) with S = H_x R H_x^T + Q_jl: the density of the detection, with the given innovation, before it
/// moves the pose.
double log_likelihood_marginal(const ExpectedLamp& lamp, const Eigen::Vector2d& innovation, const LampSighting& seen);

/// The paper's likelihood: the detection first moves the pose to mu_x, then ln N(z; h(mu_j, mu_x), Q_jl). This is not a
/// density of z, and too permissive.
double log_likelihood_paper(const ExpectedLamp& lamp, const Viewpoint& x_hat, const Symmetric3& R,
                            const Eigen::Vector3d& p_map, const LampSighting& seen);

/// ln P_new: the likelihood of a detection of something new, by a gate of `gate_sigmas` standard deviations (paper: 8).
inline double log_new(const LampSighting& seen, double gate_sigmas) {
  return seen.log_peak - 0.5 * gate_sigmas * gate_sigmas;
}

}  // namespace azimuth
