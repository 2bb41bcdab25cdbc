// Predicted bearings of FastSLAM's lamps.

#include <algorithm>
#include <cmath>

#include "slam/particles/fastslam_estimator.hpp"

namespace azimuth {

/// Squared gate on d^2 = nu^T S^-1 nu. The association requires ln N(nu; 0, S) > ln N(0; 0, Q) - g^2 / 2, which is
/// equivalent to d^2 below this value. (The paper's likelihood uses the residual after the detection has corrected the
/// pose, which lets more pass.)
static double gate2(const Symmetric2& S, const Symmetric2& Q, double sigmas) {
  return std::max(0.0, sigmas * sigmas - std::log(S.determinant() / Q.determinant()));
}

/// Predicts the lamps of the best particle's map within the camera's range. The gates of the two angles enclose the
/// ellipse of the joint gate.
void FastSlamEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  const Particles& particles = filter_.particles();
  const std::size_t best = filter_.best();
  const MovedPose moved = apply(particles[best].T_map_body, filter_.pending());
  const Viewpoint from(moved.T_map_body, filter_.camera().height_m);
  const Symmetric3 R = Symmetric3::of(moved.noise);
  for (std::size_t slot = 0; slot < particles[best].landmarks; ++slot) {
    const ExpectedLamp lamp =
        azimuth::expect(from, R, particles.positions(best)[slot], particles.covariances(best)[slot]);
    const Eigen::Vector2d z = direction_of(lamp.view, from.heading_rad);
    if (z.y() > filter_.camera().max_zenith_rad) continue;
    const double azimuth_rad = wrap(z.x() - rig_.camera.yaw_offset_rad), elevation_rad = kPi / 2.0 - z.y();
    const Symmetric2 Q = noise_of({.azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad});
    const Symmetric2 S = lamp.of_pose + lamp.of_point + Q;
    const double gate = gate2(S, Q, gate_sigmas_);
    out.push_back({.landmark = particles.infos(best)[slot].id,
                   .azimuth_rad = azimuth_rad,
                   .gate_rad = std::sqrt(gate * S.xx),
                   .elevation_rad = elevation_rad,
                   .gate_elevation_rad = std::sqrt(gate * S.yy),
                   .sigma_rad = std::sqrt(S.xx)});
  }
}

}  // namespace azimuth
