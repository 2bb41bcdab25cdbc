// Covariances of poses, landmarks and calibration, computed from the factor.

#include <vector>

#include "slam/smoother/smoother.hpp"

namespace azimuth {

/// The factor's unknowns of a pose are along the body's axes; R(heading) turns them into the map's axes.
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

Eigen::Matrix<double, kCalibrations, kCalibrations> Smoother::calibration_covariance() const {
  Eigen::Matrix<double, kCalibrations, kCalibrations> whole =
      Eigen::Matrix<double, kCalibrations, kCalibrations>::Zero();
  constexpr Block kBlock = BearingGraph::kCalibrationBlock;
  if (graph_.size(kBlock) == 0) return whole;
  const Eigen::MatrixXd unknown = factor_.covariance({&kBlock, 1}, graph_);
  for (int i = 0; i < kCalibrations; ++i)
    for (int j = 0; j < kCalibrations; ++j)
      if (const int a = graph_.calibration_row(i), b = graph_.calibration_row(j); a >= 0 && b >= 0)
        whole(i, j) = unknown(a, b);  // the block's rows are the first ones
  return whole;
}

Eigen::Matrix2d Smoother::point_covariance(LandmarkId id) const {
  const Unknown landmark = LandmarkOf{id};
  const Eigen::Matrix2d by_chart = graph_.landmark(id).p_by_chart();
  return by_chart * covariance({&landmark, 1}) * by_chart.transpose();
}

/// The graph estimates tangent = height * rho, where rho is the inverse distance; hence height = tangent / rho.
Eigen::Matrix3d Smoother::point_covariance_with_height(LandmarkId id) const {
  const std::vector<Block> blocks{graph_.block_of_landmark(id), graph_.block_of_height(id)};
  const double rho_per_m = graph_.landmark(id).inverse_distance_per_m;
  Eigen::Matrix3d to_point = Eigen::Matrix3d::Zero();
  to_point.topLeftCorner<2, 2>() = graph_.landmark(id).p_by_chart();
  to_point(2, 1) = -graph_.height_m(id) / rho_per_m;
  to_point(2, 2) = 1.0 / rho_per_m;
  return to_point * factor_.covariance(blocks, graph_) * to_point.transpose();
}

}  // namespace azimuth
