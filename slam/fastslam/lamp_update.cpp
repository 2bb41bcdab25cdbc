#include "slam/fastslam/lamp_update.hpp"

namespace azimuth {

void PoseProposal::add(const LampView& view, const Eigen::Vector2d& innovation, const Symmetric2& Q) {
  const Both moved = view.by_x * step_.x() + view.by_y * step_.y() - Both{step_.z(), 0.0};
  correct(view, innovation - Eigen::Vector2d(moved[0], moved[1]), Q);
}

void PoseProposal::add_relinearised(const Eigen::Vector3d& p_map, const Symmetric3& Sigma, const LampSighting& seen,
                                    double height_m) {
  const Viewpoint from(mean(), height_m);
  const LampView here = view(from, p_map);
  correct(here, innovation(here, from, seen), here.of_point(Sigma) + seen.covariance);
}

void PoseProposal::correct(const LampView& view, const Eigen::Vector2d& nu, const Symmetric2& Q) {
  const TwoRows H = view.by_pose(), HP = H.times(covariance_);
  const Symmetric2 S = quadratic(H, HP) + Q;
  azimuth::correct(HP, S, nu, step_, covariance_);
  log_likelihood_ += log_normal(nu, S);
}

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
