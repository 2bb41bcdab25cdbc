#include "slam/fastslam/pose_proposal.hpp"

namespace azimuth {

void PoseProposal::add(const LampView& view, const Eigen::Vector2d& innovation, const Symmetric2& Q) {
  const Eigen::Vector2d moved(view.a * step_.x() + view.b * step_.y() - step_.z(),
                              view.c * step_.x() + view.d * step_.y());
  correct(view, innovation - moved, Q);
}

void PoseProposal::add_relinearised(const Eigen::Vector3d& p_map, const Symmetric3& Sigma, const LampSighting& seen,
                                    double height_m) {
  const Viewpoint from(mean(), height_m);
  const LampView here = view(from, p_map);
  correct(here, innovation(here, from, seen), here.of_point(Sigma) + seen.covariance);
}

void PoseProposal::correct(const LampView& view, const Eigen::Vector2d& nu, const Symmetric2& Q) {
  const Symmetric2 S = view.of_pose(covariance_) + Q;
  azimuth::correct(covariance_.times(view.a, view.b, -1.0), covariance_.times(view.c, view.d, 0.0), S, nu, step_,
                   covariance_);
  log_likelihood_ += log_normal(nu, S);
}

}  // namespace azimuth
