#pragma once
// Algorithm 2: how likely a sighting is of a landmark (SPEC II.4).

#include "slam/fastslam/lamp_view.hpp"

namespace azimuth {

/// A landmark as a particle expects to see it from x_hat.
struct ExpectedLamp {
  LampView view;
  Symmetric2 of_point;    ///< H_m Sigma H_m^T
  Symmetric2 of_pose;     ///< H_x R H_x^T
  double trace_m2 = 0.0;  ///< of Sigma: the smaller, the more certain
  int slot = 0;           ///< of the landmark in the particle's map
};
ExpectedLamp expect(const Viewpoint& x_hat, const Symmetric3& R, const Eigen::Vector3d& p_map, const Symmetric3& Sigma);

/// ln N(z; zbar, S), S = H_x R H_x^T + Q_jl: the density of the sighting before it has moved the pose, off by
/// `innovation`.
double log_likelihood_marginal(const ExpectedLamp& lamp, const Eigen::Vector2d& innovation, const LampSighting& seen);

/// The paper's: the sighting first moves the pose to mu_x, then ln N(z; h(mu_j, mu_x), Q_jl). No density of z, and too
/// permissive.
double log_likelihood_paper(const ExpectedLamp& lamp, const Viewpoint& x_hat, const Symmetric3& R,
                            const Eigen::Vector3d& p_map, const LampSighting& seen);

/// ln P_new: what a sighting of something new is worth, a gate of `gate_sigmas` standard deviations (the paper: 8).
inline double log_new(const LampSighting& seen, double gate_sigmas) {
  return seen.log_peak - 0.5 * gate_sigmas * gate_sigmas;
}

}  // namespace azimuth
