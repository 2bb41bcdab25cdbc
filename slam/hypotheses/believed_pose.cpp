#include "slam/hypotheses/believed_pose.hpp"

namespace azimuth {

Eigen::Vector3d pose_difference(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap(to.heading_rad - from.heading_rad)};
}

BelievedPose mixture(std::span<const BelievedPose> beliefs, std::span<const double> weights, const Pose2& centre) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < beliefs.size(); ++i) mean += weights[i] * pose_difference(centre, beliefs[i].T_map_body);
  BelievedPose whole;
  whole.T_map_body = {centre.x_m + mean.x(), centre.y_m + mean.y(), wrap(centre.heading_rad + mean.z())};
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const Eigen::Vector3d off = pose_difference(centre, beliefs[i].T_map_body) - mean;
    whole.covariance += weights[i] * (beliefs[i].covariance + off * off.transpose());
  }
  return whole;
}

BelievedPose one_of_two(const BelievedPose& first, const BelievedPose& second, double first_wrong, double share) {
  const Eigen::Vector3d off = pose_difference(first.T_map_body, second.T_map_body);
  const Eigen::Vector3d told = first.T_map_body.vector() + share * off;
  const double apart = (1.0 - first_wrong) * share * share + first_wrong * (1.0 - share) * (1.0 - share);
  return {{told.x(), told.y(), wrap(told.z())},
          (1.0 - first_wrong) * first.covariance + first_wrong * second.covariance + apart * off * off.transpose()};
}

}  // namespace azimuth
