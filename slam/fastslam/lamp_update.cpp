#include "slam/fastslam/lamp_update.hpp"

namespace azimuth {

void correct(const Viewpoint& x_t, const LampSighting& seen, Eigen::Vector3d& p_map, Symmetric3& Sigma) {
  const LampView v = view(x_t, p_map);
  const Eigen::Vector2d nu = innovation(v, x_t, seen);
  const Symmetric2 Q_t = v.of_point(Sigma) + seen.covariance;
  const double over = 1.0 / Q_t.determinant();
  const Eigen::Vector3d azimuth = Sigma.times(-v.a, -v.b, 0.0), zenith = Sigma.times(-v.c, -v.d, v.e);
  const Eigen::Vector3d K_azimuth = over * (Q_t.yy * azimuth - Q_t.xy * zenith);
  const Eigen::Vector3d K_zenith = over * (Q_t.xx * zenith - Q_t.xy * azimuth);
  p_map += K_azimuth * nu.x() + K_zenith * nu.y();
  Sigma.add(-1.0, K_azimuth, azimuth);
  Sigma.add(-1.0, K_zenith, zenith);
}

double log_weight_paper(const Viewpoint& x_t, const Symmetric3& R, const LampSighting& seen,
                        const Eigen::Vector3d& p_map, const Symmetric3& Sigma) {
  const LampView v = view(x_t, p_map);
  return log_normal(innovation(v, x_t, seen), v.of_pose(R) + v.of_point(Sigma) + seen.covariance);
}

}  // namespace azimuth
