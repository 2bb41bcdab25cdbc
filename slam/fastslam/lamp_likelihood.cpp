#include "slam/fastslam/lamp_likelihood.hpp"

#include "slam/fastslam/lamp_update.hpp"

namespace azimuth {

ExpectedLamp expect(const Viewpoint& x_hat, const Symmetric3& R, const Eigen::Vector3d& p_map,
                    const Symmetric3& Sigma) {
  ExpectedLamp lamp;
  lamp.view = view(x_hat, p_map);
  lamp.of_point = lamp.view.of_point(Sigma);
  lamp.of_pose = lamp.view.of_pose(R);
  lamp.trace_m2 = Sigma.trace();
  return lamp;
}

double log_likelihood_marginal(const ExpectedLamp& lamp, const Eigen::Vector2d& innovation, const LampSighting& seen) {
  return log_normal(innovation, lamp.of_pose + lamp.of_point + seen.covariance);
}

double log_likelihood_paper(const ExpectedLamp& lamp, const Viewpoint& x_hat, const Symmetric3& R,
                            const Eigen::Vector3d& p_map, const LampSighting& seen) {
  const Symmetric2 Q_jl = lamp.of_point + seen.covariance;
  PoseProposal moved(x_hat.pose(), R);
  moved.add(lamp.view, innovation(lamp.view, x_hat, seen), Q_jl);
  const Viewpoint mu_x(moved.mean(), x_hat.z_m);
  return log_normal(innovation(view(mu_x, p_map), mu_x, seen), Q_jl);
}

}  // namespace azimuth
