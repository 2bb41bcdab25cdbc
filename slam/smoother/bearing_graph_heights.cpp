// The terms of elevations, the second residual of some bearings, and the landmarks' heights above the camera.

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {

/// Starts a height from the first elevation and the landmark's current position.
void BearingGraph::begin_height(BearingId first, LandmarkId landmark) {
  const SmoothedLandmark& state = landmarks_[landmark].state;
  const Eigen::Vector2d to_chart = state.p_map_chart - pose(bearings_[first].pose).position();
  const Eigen::Vector2d B = state.inverse_distance_per_m * to_chart + state.direction;
  const double elevation_rad = elevations_[bearings_[first].elevation].measured.elevation_rad;
  const auto id = heights_.size();
  heights_.push_back(
      {.landmark = landmark, .block = add_block(Kind::height, id, 1), .tangent = std::tan(elevation_rad) * B.norm()});
  landmarks_.edit(landmark).height = id;
}

void BearingGraph::count_elevation(LandmarkId landmark, int more) {
  heights_.edit(landmarks_[landmark].height).elevations += more;
}

double BearingGraph::height_m(LandmarkId id) const {
  const LandmarkEntry& landmark = landmarks_[id];
  if (elevations_of(id) == 0 || !landmark.state.is_point()) return std::numeric_limits<double>::quiet_NaN();
  return heights_[landmark.height].tangent / landmark.state.inverse_distance_per_m;
}

double BearingGraph::elevation_chi2_of(BearingId id) const {
  if (!has_elevation(id) || links_[id].landmark == kOfNothing) return 0.0;
  const double residual = elevations_[bearings_[id].elevation].residual;
  return residual * residual;
}

void BearingGraph::move_heights(const Eigen::VectorXd& step) {
  for (std::int32_t i = 0; i < heights_.size(); ++i) {
    if (size(heights_[i].block) == 0) continue;
    HeightEntry& height = heights_.edit(i);
    height.tangent += step[first_row(height.block)];
    landmarks_.edit(height.landmark).moved = true;
  }
}

/// Must run after the azimuth of the bearing was evaluated.
void BearingGraph::evaluate_elevation(BearingId id) {
  const BearingMeasurement& bearing = bearings_[id];
  const LandmarkEntry& landmark = landmarks_[links_[id].landmark];
  const HeightEntry& height = heights_[landmark.height];
  const PoseEntry& pose = poses_[bearing.pose];
  ElevationEntry& elevation = elevations_.edit(bearing.elevation);
  SeenElevation seen;
  if (see_height(pose.state, landmark.state, height.tangent, settings_.min_distance_m, seen)) {
    const double per_sigma = 1.0 / elevation.measured.sigma_rad;
    elevation.residual = (seen.elevation_rad - elevation.measured.elevation_rad) * per_sigma;
    const auto [energy, weight] =
        kernel_value(settings_.kernel, settings_.kernel_width, elevation.residual * elevation.residual);
    elevation.energy = energy;
    elevation.weight = weight;
    elevation.by_pose = seen.by_pose * per_sigma;
    elevation.by_landmark = seen.by_landmark * per_sigma;
    elevation.by_tangent = seen.by_tangent * per_sigma;
  } else {
    elevation.residual = elevation.energy = elevation.weight = 0.0;
  }
  if (!is_stale(elevation)) return;
  stale_.emplace_back(pose.block, landmark.block);
  stale_.emplace_back(pose.block, height.block);
  stale_.emplace_back(landmark.block, height.block);
}

bool BearingGraph::is_stale(const ElevationEntry& elevation) const {
  if (std::abs(elevation.weight - elevation.factor_weight) > settings_.reweigh_beyond * elevation.factor_weight)
    return true;
  Eigen::Matrix<double, 5, 1> now;
  now << elevation.by_pose.head<2>(), elevation.by_landmark, elevation.by_tangent;
  const double allowed = settings_.relinearise_beyond / elevation.measured.sigma_rad;
  return (now - elevation.factor_derivatives).squaredNorm() > allowed * allowed;
}

void BearingGraph::sum_elevation(BearingId id) {
  const ElevationEntry& elevation = elevations_[bearings_[id].elevation];
  const LandmarkEntry& landmark = landmarks_[links_[id].landmark];
  const Block pose = poses_[bearings_[id].pose].block;
  const double pull = elevation.weight * elevation.residual;
  energy_ += elevation.energy;
  if (size(pose) > 0) gradient_.segment<3>(first_row(pose)) += pull * elevation.by_pose;
  gradient_.segment<2>(first_row(landmark.block)) += pull * elevation.by_landmark;
  gradient_[first_row(heights_[landmark.height].block)] += pull * elevation.by_tangent;
}

void BearingGraph::append_height_neighbours(const HeightEntry& height, std::vector<Block>& out) const {
  out.push_back(landmarks_[height.landmark].block);
  for (const BearingId bearing : landmarks_[height.landmark].bearings)
    if (has_elevation(bearing)) out.push_back(poses_[bearings_[bearing].pose].block);
}

void BearingGraph::add_height_terms(const HeightEntry& height, FrontMatrix& front) {
  const int row = front.row_of(first_row(height.block));
  const LandmarkEntry& landmark = landmarks_[height.landmark];
  if (!comes_later(front, landmark.block, row)) return;
  for (const BearingId bearing : landmark.bearings)
    if (has_elevation(bearing) && comes_later(front, poses_[bearings_[bearing].pose].block, row))
      add_elevation(bearing, front);
}

void BearingGraph::add_elevation(BearingId id, FrontMatrix& front) {
  using Vector1d = Eigen::Matrix<double, 1, 1>;
  const ElevationEntry& elevation = elevations_[bearings_[id].elevation];
  const LandmarkEntry& landmark = landmarks_[links_[id].landmark];
  const Block pose = poses_[bearings_[id].pose].block;
  const Eigen::Vector3d by_pose = elevation.by_pose;
  const Eigen::Vector2d by_landmark = elevation.by_landmark;
  const Vector1d by_tangent(elevation.by_tangent), weighed_tangent(elevation.weight * elevation.by_tangent);
  const Eigen::Vector2d weighed_landmark = elevation.weight * by_landmark;
  const int row = front.row_of(first_row(landmark.block));
  const int height_row = front.row_of(first_row(heights_[landmark.height].block));
  front.add_product(row, weighed_landmark, row, by_landmark);
  front.add_product(height_row, weighed_tangent, height_row, by_tangent);
  front.add_product(row, weighed_landmark, height_row, by_tangent);
  if (size(pose) > 0) {
    const int pose_row = front.row_of(first_row(pose));
    front.add_product(pose_row, Eigen::Vector3d(elevation.weight * by_pose), pose_row, by_pose);
    front.add_product(row, weighed_landmark, pose_row, by_pose);
    front.add_product(height_row, weighed_tangent, pose_row, by_pose);
  }
  if (!front.is_kept()) return;
  ElevationEntry& kept = elevations_.edit(bearings_[id].elevation);
  kept.factor_weight = elevation.weight;
  kept.factor_derivatives << by_pose.head<2>(), by_landmark, by_tangent;
}

}  // namespace azimuth
