// How uncertain poses and landmarks are, from the factor.

#include <vector>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// The factor's unknowns of a pose are along its own axes; the map's are R(h) of that.
Eigen::MatrixXd Smoother::covariance(std::span<const Unknown> unknowns) const {
  std::vector<Block> blocks;
  Eigen::Index rows = 0;
  for (const Unknown& unknown : unknowns) {
    const auto* const pose = std::get_if<PoseOf>(&unknown);
    blocks.push_back(pose != nullptr ? graph_.block_of_pose(pose->id)
                                     : graph_.block_of_landmark(std::get<LandmarkOf>(unknown).id));
    rows += graph_.size(blocks.back());
  }
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Identity(rows, rows);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const auto* const pose = std::get_if<PoseOf>(&unknowns[i]); pose != nullptr && graph_.size(blocks[i]) > 0)
      to_map.block<2, 2>(row, row) = rotation(graph_.pose(pose->id).heading_rad);
    row += graph_.size(blocks[i]);
  }
  return to_map * factor_.covariance(blocks, graph_) * to_map.transpose();
}

Eigen::Matrix3d Smoother::pose_covariance(PoseId id) const {
  if (graph_.size(graph_.block_of_pose(id)) == 0) return Eigen::Matrix3d::Zero();
  const Unknown pose = PoseOf{id};
  return covariance({&pose, 1});
}

Eigen::Matrix2d Smoother::point_covariance(LandmarkId id) const {
  const Unknown landmark = LandmarkOf{id};
  const Eigen::Matrix2d by_chart = graph_.landmark(id).p_by_chart();
  return by_chart * covariance({&landmark, 1}) * by_chart.transpose();
}

}  // namespace azimuth
