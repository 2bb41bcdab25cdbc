#include "slam/hypotheses/window_belief.hpp"

#include <algorithm>

namespace azimuth {

WindowBelief::WindowBelief(const Smoother& smoother, PoseId first, std::span<const LandmarkId> landmarks,
                           double min_distance_m)
    : first_(first),
      poses_(static_cast<std::size_t>(smoother.graph().poses() - first)),
      row_of_landmark_(static_cast<std::size_t>(smoother.graph().landmarks()), -1),
      landmarks_(landmarks.size()) {
  const BearingGraph& graph = smoother.graph();
  std::vector<Block> blocks;
  std::vector<Eigen::Index> starts;
  Eigen::Index rows = 0;
  const auto add = [&](Block block) {
    blocks.push_back(block);
    starts.push_back(rows);
    rows += graph.size(block);
  };
  for (PoseId pose = first; pose < graph.poses(); ++pose) add(graph.block_of_pose(pose));
  for (std::size_t j = 0; j < landmarks.size(); ++j) {
    row_of_landmark_[static_cast<std::size_t>(landmarks[j])] = static_cast<int>(j);
    add(graph.block_of_landmark(landmarks[j]));
  }
  const Eigen::MatrixXd P = smoother.factor().covariance(blocks, graph);
  const auto of_poses = [&](std::size_t a, std::size_t b) -> Eigen::Matrix3d {
    if (graph.size(blocks[a]) == 0 || graph.size(blocks[b]) == 0) return Eigen::Matrix3d::Zero();
    return P.block<3, 3>(starts[a], starts[b]);
  };

  const std::size_t newest = poses_ - 1;
  const SmoothedPose& end = graph.smoothed_pose(graph.poses() - 1);
  variances_.assign(poses_ * landmarks_, -1.0);
  for (std::size_t i = 0; i < poses_; ++i) {
    const SmoothedPose& pose = graph.smoothed_pose(first + static_cast<PoseId>(i));
    const SmoothedPose camera = graph.camera_at(first + static_cast<PoseId>(i));
    // A is the change of this pose when the newest pose moves and everything moves with it.
    const Eigen::Vector2d from_end = pose.T_map_body.position() - end.T_map_body.position();
    const Eigen::Vector2d turned = pose.to_body({-from_end.y(), from_end.x()});
    const Eigen::Vector2d axis = pose.to_body(end.forwards);
    Eigen::Matrix3d A;
    A << axis.x(), -axis.y(), turned.x(),  //
        axis.y(), axis.x(), turned.y(),    //
        0.0, 0.0, 1.0;
    const Eigen::Matrix3d cross = of_poses(i, newest) * A.transpose();
    relative_.push_back(i == newest ? Eigen::Matrix3d(Eigen::Matrix3d::Zero())
                                    : Eigen::Matrix3d(of_poses(i, i) - cross - cross.transpose() +
                                                      A * of_poses(newest, newest) * A.transpose()));

    const Eigen::Matrix3d own = of_poses(i, i);
    const bool is_free = graph.size(blocks[i]) > 0;
    for (std::size_t j = 0; j < landmarks_; ++j) {
      SeenAzimuth seen;
      if (!see(camera, graph.landmark(landmarks[j]), min_distance_m, seen)) continue;
      const Eigen::Index row = starts[poses_ + j];
      double variance =
          seen.by_landmark.dot(P.block<2, 2>(row, row) * seen.by_landmark) + seen.by_pose.dot(own * seen.by_pose);
      if (is_free) variance += 2.0 * seen.by_pose.dot(P.block<3, 2>(starts[i], row) * seen.by_landmark);
      variances_[i * landmarks_ + j] = std::max(variance, 0.0);
    }
  }
}

double WindowBelief::variance(PoseId pose, LandmarkId landmark) const {
  if (pose < first_ || static_cast<std::size_t>(landmark) >= row_of_landmark_.size()) return -1.0;
  const int row = row_of_landmark_[static_cast<std::size_t>(landmark)];
  return row < 0 ? -1.0 : variances_[index(pose) * landmarks_ + static_cast<std::size_t>(row)];
}

}  // namespace azimuth
