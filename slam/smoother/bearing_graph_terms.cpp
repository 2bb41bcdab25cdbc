// The terms of a bearing graph: residuals, energies and derivatives, and their parts of the normal matrix.

#include <algorithm>
#include <cmath>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {
namespace {

// Unit of inverse distance that makes a derivative by rho comparable with those by metres and radians.
constexpr double kTypicalInverseDistance_per_m = 0.25;

}  // namespace

void BearingGraph::evaluate() {
  gradient_.setZero(rows_);
  energy_ = 0.0;
  for (PoseId id = 0; id < poses_.size(); ++id) {
    const bool moved = poses_[id].moved;
    if (id > 0) {
      if (moved || poses_[id - 1].moved || (calibration_moved_ && calibrates_odometry_)) evaluate_odometry(id);
      sum_odometry(id);
    }
    const BearingId end = end_of_bearings(id);
    for (BearingId bearing = poses_[id].first_bearing; bearing < end; ++bearing) {
      const LandmarkId landmark = links_[bearing].landmark;
      if (landmark == kOfNothing) continue;
      if (moved || landmarks_[landmark].moved || links_[bearing].changed || (calibration_moved_ && calibrates_camera_))
        evaluate_bearing(bearing);
      sum_bearing(bearing);
      if (has_elevation(bearing)) sum_elevation(bearing);
    }
  }
  sum_priors();
  for (PoseId i = 0; i < poses_.size(); ++i)
    if (poses_[i].moved) poses_.edit(i).moved = false;
  for (LandmarkId i = 0; i < landmarks_.size(); ++i)
    if (landmarks_[i].moved) landmarks_.edit(i).moved = false;
  calibration_moved_ = false;
}

void BearingGraph::evaluate_odometry(PoseId id) {
  const OdometryMeasurement& measured = odometry_[id];
  PoseEntry& pose = poses_.edit(id);
  const SeenMotion seen = see_motion(poses_[id - 1].state, pose.state);
  pose.relative = seen.relative;
  Eigen::Vector3d off = pose.relative - measured.relative;
  if (calibration_size_ > 0) off -= measured.by_calibration * calibration_.head<kOdometryCalibrations>();
  off.z() = wrap(off.z());
  const Eigen::Vector3d residual = measured.whitening * off;
  pose.pull = measured.whitening.transpose() * residual;
  pose.pull_start = seen.by_start.transpose() * pose.pull;
  pose.pull_end = seen.by_end.transpose() * pose.pull;
  pose.energy = 0.5 * residual.squaredNorm();
  if (is_stale(pose, measured)) stale_.emplace_back(poses_[id - 1].block, pose.block);
}

void BearingGraph::evaluate_bearing(BearingId id) {
  const BearingMeasurement& measured = bearings_[id];
  Link& link = links_.edit(id);
  link.changed = false;
  const PoseEntry& pose = poses_[measured.pose];
  SeenAzimuth seen;
  if (see(camera_at(pose.state), landmarks_[link.landmark].state, settings_.min_distance_m, seen)) {
    // The camera is off the robot's centre of rotation, so a turn of the robot also moves the camera.
    seen.by_pose.z() +=
        seen.by_pose.y() * calibration_[calibration::camera_x] - seen.by_pose.x() * calibration_[calibration::camera_y];
    const double per_sigma = 1.0 / measured.sigma_rad;
    link.residual = wrap(seen.azimuth_rad - camera_error_rad(measured) - measured.azimuth_rad) * per_sigma;
    const auto [energy, weight] = kernel_value(settings_.kernel, settings_.kernel_width, link.residual * link.residual);
    link.energy = energy;
    link.weight = weight;
    link.by_pose = seen.by_pose * per_sigma;
    link.by_landmark = seen.by_landmark * per_sigma;
  } else {  // the bearing has no effect
    link.residual = link.energy = link.weight = 0.0;
  }
  if (is_stale(link, measured)) stale_.emplace_back(pose.block, landmarks_[link.landmark].block);
  if (has_elevation(id)) evaluate_elevation(id);
}

/// The derivatives depend on the relative pose only. A wrong turn in them would misstate a turn of the map, so its
/// threshold is absolute; an error in position only matters per standard deviation of the odometry.
bool BearingGraph::is_stale(const PoseEntry& pose, const OdometryMeasurement& measured) const {
  const Eigen::Vector3d changed = pose.relative - pose.factor_relative;
  const double turned = std::abs(changed.z()) / settings_.relinearise_beyond;
  const double shifted = (measured.whitening.leftCols<2>() * changed.head<2>()).squaredNorm();
  constexpr double kShift2 = 0.05 * 0.05;
  return turned > 1.0 || shifted > kShift2;
}

bool BearingGraph::is_stale(const Link& link, const BearingMeasurement& measured) const {
  const double factor_weight = static_cast<double>(link.factor_weight);
  if (std::abs(link.weight - factor_weight) > settings_.reweigh_beyond * factor_weight) return true;
  const auto was = [&](std::size_t i) { return static_cast<double>(link.factor_derivatives[i]); };
  const Eigen::Vector4d changed{link.by_pose.x() - was(0), link.by_pose.y() - was(1), link.by_landmark.x() - was(2),
                                (link.by_landmark.y() - was(3)) * kTypicalInverseDistance_per_m};
  const double allowed = settings_.relinearise_beyond / measured.sigma_rad;
  return changed.squaredNorm() > allowed * allowed;
}

void BearingGraph::sum_odometry(PoseId id) {
  const PoseEntry &start = poses_[id - 1], &end = poses_[id];
  const OdometryMeasurement& measured = odometry_[id];
  energy_ += end.energy;
  if (id > 1) gradient_.segment<3>(first_row(start.block)) += end.pull_start;
  gradient_.segment<3>(first_row(end.block)) += end.pull_end;
  if (!calibrates_odometry_) return;
  for (std::size_t i = 0; i < kOdometryCalibrations; ++i)
    if (const int row = calibration_row_[i]; row >= 0)
      gradient_[row] -= measured.by_calibration.col(static_cast<Eigen::Index>(i)).dot(end.pull);
}

void BearingGraph::sum_bearing(BearingId id) {
  const Link& link = links_[id];
  energy_ += link.energy;
  add_pull(link, bearings_[id], link.weight * link.residual, gradient_);
}

void BearingGraph::add_pull(const Link& link, const BearingMeasurement& measured, double pull,
                            Eigen::VectorXd& sum) const {
  const Block pose = poses_[measured.pose].block;
  if (size(pose) > 0) sum.segment<3>(first_row(pose)) += pull * link.by_pose;
  sum.segment<2>(first_row(landmarks_[link.landmark].block)) += pull * link.by_landmark;
  if (!calibrates_camera_) return;
  const ByCamera by = by_camera(link, measured);
  for (int i = 0; i < kCameraCalibrations; ++i)
    if (const int row = calibration_row(kOdometryCalibrations + i); row >= 0) sum[row] += pull * by[i];
}

double BearingGraph::bounded_energy(double most) const {
  double energy = energy_;
  for (BearingId id = 0; id < bearings_.size(); ++id)
    if (links_[id].landmark != kOfNothing) energy += std::min(0.5 * chi2_of(id), most) - links_[id].energy;
  return energy;
}

void BearingGraph::sum_priors() {
  for (LandmarkId i = 0; i < landmarks_.size(); ++i) {
    const LandmarkEntry& landmark = landmarks_[i];
    if (landmark.known || landmark.bearings.empty()) continue;
    const double information = prior_information(i);
    const double off_per_m = landmark.state.inverse_distance_per_m - landmark.prior_mean_per_m;
    energy_ += 0.5 * information * off_per_m * off_per_m;
    gradient_[first_row(landmark.block) + 1] += information * off_per_m;
  }
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (const int row = calibration_row_[i]; row >= 0) {
      const double sigmas = calibration_[static_cast<Eigen::Index>(i)] / calibration_sigma_[i];
      energy_ += 0.5 * sigmas * sigmas;
      gradient_[row] += sigmas / calibration_sigma_[i];
    }
  sum_remembered();
}

void BearingGraph::append_neighbours(Block block, std::vector<Block>& out) const {
  const BlockEntry& entry = blocks_[block];
  if (entry.kind == Kind::calibration) return;  // all other blocks list it as a neighbour
  if (is_remembered(block)) append_remembered(block, out);
  if (entry.kind == Kind::landmark) {
    for (const BearingId bearing : landmarks_[entry.id].bearings) out.push_back(poses_[bearings_[bearing].pose].block);
    if (calibrates_camera_) out.push_back(kCalibrationBlock);
    if (elevations_of(entry.id) > 0) out.push_back(block_of_height(entry.id));
    return;
  }
  if (entry.kind == Kind::height) return append_height_neighbours(heights_[entry.id], out);
  if (entry.id > 0) out.push_back(poses_[entry.id - 1].block);
  if (entry.id + 1 < poses_.size()) out.push_back(poses_[entry.id + 1].block);
  for (BearingId bearing = poses_[entry.id].first_bearing; bearing < end_of_bearings(entry.id); ++bearing)
    if (const LandmarkId landmark = landmark_of(bearing); landmark != kOfNothing) {
      out.push_back(landmarks_[landmark].block);
      if (has_elevation(bearing)) out.push_back(block_of_height(landmark));
    }
  if (calibration_size_ > 0) out.push_back(kCalibrationBlock);
}

void BearingGraph::add_terms(Block block, FrontMatrix& front) {
  const BlockEntry entry = blocks_[block];
  if (is_remembered(block)) add_remembered(block, front);
  switch (entry.kind) {
    case Kind::calibration:
      return add_calibration_terms(front);
    case Kind::pose:
      return add_pose_terms(entry.id, front);
    case Kind::landmark:
      return add_landmark_terms(entry.id, front);
    case Kind::height:
      return add_height_terms(heights_[entry.id], front);
  }
}

/// Whether `block` comes after local row `row`, so that a term of both belongs to the block at `row`. A block that is
/// no unknown is not in the matrix and counts as later.
bool BearingGraph::comes_later(const FrontMatrix& front, Block block, int row) const {
  return size(block) == 0 || front.row_of(first_row(block)) > row;
}

void BearingGraph::add_pose_terms(PoseId id, FrontMatrix& front) {
  const int row = front.row_of(first_row(poses_[id].block));
  if (comes_later(front, poses_[id - 1].block, row)) add_odometry(id, front);
  if (id + 1 < poses_.size() && comes_later(front, poses_[id + 1].block, row)) add_odometry(id + 1, front);
  for (BearingId bearing = poses_[id].first_bearing; bearing < end_of_bearings(id); ++bearing) {
    const LandmarkId landmark = landmark_of(bearing);
    if (landmark == kOfNothing || !comes_later(front, landmarks_[landmark].block, row)) continue;
    add_bearing(bearing, front);
    if (has_elevation(bearing) && comes_later(front, block_of_height(landmark), row)) add_elevation(bearing, front);
  }
}

void BearingGraph::add_landmark_terms(LandmarkId id, FrontMatrix& front) {
  const LandmarkEntry& landmark = landmarks_[id];
  const int row = front.row_of(first_row(landmark.block));
  front.values()(row + 1, row + 1) += prior_information(id);
  for (const BearingId bearing : landmark.bearings) {
    if (!comes_later(front, poses_[bearings_[bearing].pose].block, row)) continue;
    add_bearing(bearing, front);
    if (has_elevation(bearing) && comes_later(front, block_of_height(id), row)) add_elevation(bearing, front);
  }
}

void BearingGraph::add_calibration_terms(FrontMatrix& front) const {
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (const int whole = calibration_row_[i]; whole >= 0) {
      const int row = front.row_of(whole);
      front.values()(row, row) += 1.0 / (calibration_sigma_[i] * calibration_sigma_[i]);
    }
}

void BearingGraph::add_odometry(PoseId id, FrontMatrix& front) {
  const PoseEntry &start = poses_[id - 1], &end = poses_[id];
  const OdometryMeasurement& measured = odometry_[id];
  const SeenMotion seen = see_motion(start.state, end.state);
  const Eigen::Matrix3d by_end = measured.whitening * seen.by_end;
  const int end_row = front.row_of(first_row(end.block));
  const Eigen::Matrix3d by_end_t = by_end.transpose();
  front.add(end_row, end_row, Eigen::Matrix3d(by_end_t * by_end));
  const bool free_start = size(start.block) > 0;
  const Eigen::Matrix3d by_start_t = (measured.whitening * seen.by_start).transpose();
  const int start_row = free_start ? front.row_of(first_row(start.block)) : FrontMatrix::kNotHere;
  if (free_start) {
    front.add(start_row, start_row, Eigen::Matrix3d(by_start_t * by_start_t.transpose()));
    front.add(end_row, start_row, Eigen::Matrix3d(by_end_t * by_start_t.transpose()));
  }
  if (calibrates_odometry_) {
    const Eigen::Matrix<double, 3, kOdometryCalibrations> by_calibration =
        -measured.whitening * measured.by_calibration;
    for (int i = 0; i < kOdometryCalibrations; ++i) {
      if (!calibrates(i)) continue;
      const int row = front.row_of(calibration_row_[static_cast<std::size_t>(i)]);
      front.add(row, end_row, Eigen::RowVector3d((by_end_t * by_calibration.col(i)).transpose()));
      if (free_start) front.add(row, start_row, Eigen::RowVector3d((by_start_t * by_calibration.col(i)).transpose()));
      for (int j = 0; j <= i; ++j)
        if (calibrates(j))
          front.values()(row, front.row_of(calibration_row_[static_cast<std::size_t>(j)])) +=
              by_calibration.col(i).dot(by_calibration.col(j));
    }
  }
  if (front.is_kept()) poses_.edit(id).factor_relative = end.relative;
}

void BearingGraph::add_bearing(BearingId id, FrontMatrix& front) {
  const Link& link = links_[id];
  const PoseEntry& pose = poses_[bearings_[id].pose];
  const Eigen::Vector3d by_pose = link.by_pose;
  const Eigen::Vector2d by_landmark = link.by_landmark;
  const int row = front.row_of(first_row(landmarks_[link.landmark].block));
  front.add_product(row, Eigen::Vector2d(link.weight * by_landmark), row, by_landmark);
  const bool free_pose = size(pose.block) > 0;
  const int pose_row = free_pose ? front.row_of(first_row(pose.block)) : FrontMatrix::kNotHere;
  if (free_pose) {
    front.add_product(pose_row, Eigen::Vector3d(link.weight * by_pose), pose_row, by_pose);
    front.add_product(row, Eigen::Vector2d(link.weight * by_landmark), pose_row, by_pose);
  }
  if (calibrates_camera_) add_camera(link, bearings_[id], row, pose_row, front);
  if (!front.is_kept()) return;
  Link& kept = links_.edit(id);
  kept.factor_weight = static_cast<float>(link.weight);
  kept.factor_derivatives = {static_cast<float>(by_pose.x()), static_cast<float>(by_pose.y()),
                             static_cast<float>(by_landmark.x()), static_cast<float>(by_landmark.y())};
}

void BearingGraph::add_camera(const Link& link, const BearingMeasurement& measured, int landmark_row, int pose_row,
                              FrontMatrix& front) const {
  const ByCamera by = by_camera(link, measured);
  for (int i = 0; i < kCameraCalibrations; ++i) {
    if (!calibrates(kOdometryCalibrations + i)) continue;
    const int row = front.row_of(calibration_row(kOdometryCalibrations + i));
    const Eigen::Matrix<double, 1, 1> by_this(link.weight * by[i]);
    front.add_product(row, by_this, landmark_row, link.by_landmark);
    if (pose_row != FrontMatrix::kNotHere) front.add_product(row, by_this, pose_row, link.by_pose);
    for (int j = 0; j <= i; ++j)
      if (calibrates(kOdometryCalibrations + j))
        front.values()(row, front.row_of(calibration_row(kOdometryCalibrations + j))) += by_this.x() * by[j];
  }
}

}  // namespace azimuth
