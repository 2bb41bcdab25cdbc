#include "slam/fastslam/lamp_update.hpp"

namespace azimuth {

void correct(const Viewpoint& x_t, const LampSighting& seen, Eigen::Vector3d& p_map, Symmetric3& Sigma) {
  const LampView v = view(x_t, p_map);
  const Eigen::Vector2d nu = innovation(v, x_t, seen);
  const TwoRows H = v.by_point(), HSigma = H.times(Sigma);
  correct(HSigma, quadratic(H, HSigma) + seen.covariance, nu, p_map, Sigma);
}

double log_weight_paper(const Viewpoint& x_t, const Symmetric3& R, const LampSighting& seen,
                        const Eigen::Vector3d& p_map, const Symmetric3& Sigma) {
  const LampView v = view(x_t, p_map);
  return log_normal(innovation(v, x_t, seen), v.of_pose(R) + v.of_point(Sigma) + seen.covariance);
}

}  // namespace azimuth
