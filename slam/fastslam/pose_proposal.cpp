#include "slam/fastslam/pose_proposal.hpp"

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

}  // namespace azimuth
