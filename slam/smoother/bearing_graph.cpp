#include "slam/smoother/bearing_graph.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kFarthestShift = 0.5;  // in units of the landmark's distance

}  // namespace

BearingGraph::BearingGraph(const SmootherSettings& settings, const Pose2& T_map_first) : settings_(settings) {
  const Calibration sigma = sigmas(settings.calibration);
  std::ranges::copy(sigma, calibration_sigma_.begin());
  for (std::size_t i = 0; i < kCalibrations; ++i)
    calibration_row_[i] = calibration_sigma_[i] > 0.0 ? calibration_size_++ : -1;
  const auto is_unknown = [](int row) { return row >= 0; };
  calibrates_odometry_ = std::ranges::any_of(std::span(calibration_row_).first<kOdometryCalibrations>(), is_unknown);
  calibrates_camera_ = std::ranges::any_of(std::span(calibration_row_).last<kCameraCalibrations>(), is_unknown);
  add_block(Kind::calibration, 0, calibration_size_);
  PoseEntry first;
  first.state = SmoothedPose(T_map_first);
  first.block = add_block(Kind::pose, 0, 0);
  poses_.push_back(first);
  odometry_.push_back({});
}

Block BearingGraph::add_block(Kind kind, std::int32_t id, int size) {
  blocks_.push_back({kind, id, rows_});
  rows_ += size;
  return blocks_.size() - 1;
}

PoseId BearingGraph::add_pose(const Motion& motion, const ByLag& by_lag) {
  const auto id = poses_.size();
  const OdometryMeasurement odometry = odometry_measurement(motion, by_lag);
  const Eigen::Vector3d expected =
      odometry.relative + odometry.by_calibration * calibration_.head<kOdometryCalibrations>();

  PoseEntry pose;
  pose.state = SmoothedPose(poses_.back().state.T_map_body * Pose2{expected.x(), expected.y(), wrap(expected.z())});
  pose.block = add_block(Kind::pose, id, 3);
  pose.first_bearing = bearings_.size();
  poses_.push_back(pose);
  odometry_.push_back(odometry);
  return id;
}

BearingId BearingGraph::add_bearing(double azimuth_rad, double sigma_rad,
                                    const std::optional<MeasuredElevation>& elevation, const ByCentre& by_centre) {
  bearings_.push_back(
      {poses_.size() - 1, elevation ? elevations_.size() : kNoElevation, azimuth_rad, sigma_rad, by_centre});
  if (elevation) elevations_.push_back({.measured = *elevation});
  links_.push_back({});
  return bearings_.size() - 1;
}

LandmarkId BearingGraph::add_landmark(BearingId first) {
  const BearingMeasurement& seen = bearings_[first];
  const Pose2 T_map_camera = camera_at(smoothed_pose(seen.pose)).T_map_body;
  const auto id = landmarks_.size();
  LandmarkEntry landmark;
  landmark.state = {T_map_camera.position(), T_map_camera.heading_rad + seen.azimuth_rad + camera_error_rad(seen),
                    settings_.inverse_depth_mean_per_m};
  landmark.prior_mean_per_m = settings_.inverse_depth_mean_per_m;
  landmark.block = add_block(Kind::landmark, id, 2);
  landmarks_.push_back(landmark);
  return id;
}

void BearingGraph::assign(BearingId bearing, LandmarkId landmark) {
  Link& link = links_.edit(bearing);
  if (link.landmark == landmark) return;
  if (link.landmark != kOfNothing) {
    std::erase(landmarks_.edit(link.landmark).bearings, bearing);
    if (has_elevation(bearing)) count_elevation(link.landmark, -1);
  }
  link = Link{};
  link.landmark = landmark;
  link.changed = true;
  if (landmark == kOfNothing) return;
  landmarks_.edit(landmark).bearings.push_back(bearing);
  if (!has_elevation(bearing)) return;
  if (landmarks_[landmark].height == kNoHeight) begin_height(bearing, landmark);
  count_elevation(landmark, 1);
}

void BearingGraph::set_kernel(RobustKernel kernel, double width) {
  settings_.kernel = kernel;
  settings_.kernel_width = width;
  for (PoseId i = 0; i < poses_.size(); ++i) poses_.edit(i).moved = true;
}

double BearingGraph::chi2_of(BearingId id) const {
  const Link& link = links_[id];
  return link.residual * link.residual;
}

void BearingGraph::use_prior(LandmarkId id, bool used) {
  LandmarkEntry& landmark = landmarks_.edit(id);
  landmark.prior = used;
  landmark.prior_mean_per_m = settings_.inverse_depth_mean_per_m;
}

/// Contradictory bearings may push a landmark to its chart origin, where rho grows without bound. Bearings have no
/// derivative there, and the singular normal matrix would stop the whole graph. A prior that is off therefore keeps a
/// weak remnant that prevents this.
double BearingGraph::prior_information(LandmarkId id) const {
  if (landmarks_[id].known) return 0.0;
  const double sigma_per_m = (landmarks_[id].prior ? 1.0 : kTraceOfPrior_sigmas) * settings_.inverse_depth_sigma_per_m;
  return 1.0 / (sigma_per_m * sigma_per_m);
}

double BearingGraph::told_information(LandmarkId id) const {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const BearingId bearing : landmarks_[id].bearings) {
    const Link& link = links_[bearing];
    if (link.residual * link.residual < kFitsChi2)
      information += link.weight * link.by_landmark * link.by_landmark.transpose();
  }
  if (!(information(0, 0) > 0.0)) return 0.0;
  return information(1, 1) - information(1, 0) * information(1, 0) / information(0, 0);
}

BearingGraph::Values BearingGraph::values() const {
  Values values;
  for (PoseId i = 0; i < poses_.size(); ++i) values.poses.push_back(poses_[i].state);
  for (LandmarkId i = 0; i < landmarks_.size(); ++i) {
    const LandmarkEntry& landmark = landmarks_[i];
    values.landmarks.push_back(landmark.state);
    values.tangents.push_back(landmark.height == kNoHeight ? std::numeric_limits<double>::quiet_NaN()
                                                           : heights_[landmark.height].tangent);
  }
  values.calibration = calibration_;
  return values;
}

void BearingGraph::begin_at(const Values& values) {
  assert(values.poses.size() == as_size(poses_.size()) && values.landmarks.size() == as_size(landmarks_.size()));
  for (PoseId i = 1; i < poses_.size(); ++i) {
    poses_.edit(i).state = values.poses[as_size(i)];
    poses_.edit(i).moved = true;
  }
  for (LandmarkId i = 0; i < landmarks_.size(); ++i) {
    LandmarkEntry& landmark = landmarks_.edit(i);
    landmark.state = values.landmarks[as_size(i)];
    landmark.moved = true;
  }
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (calibration_row_[i] >= 0) calibration_[as_index(i)] = values.calibration[as_index(i)];
  calibration_moved_ = true;
}

/// Must run before the poses move. The prior's mean moves along with the chart, so the prior's statement about the
/// landmark stays the same.
void BearingGraph::move_landmark(LandmarkEntry& landmark, const Eigen::Vector2d& by, const Eigen::VectorXd& step) {
  if (settings_.charts_go_along && !landmark.known) {
    const PoseEntry& first = poses_[bearings_[landmark.bearings.front()].pose];
    if (size(first.block) > 0) take_chart_along(landmark, first.state.to_map(step.segment<2>(first_row(first.block))));
  }
  landmark.state = landmark.state.moved(by);
}

/// Moves a landmark's chart origin by `shift_m`, unless the shift is of the order of the landmark's distance. The
/// first-order change of chart would then give another place, and rho would soon grow without bound.
void BearingGraph::take_chart_along(LandmarkEntry& landmark, const Eigen::Vector2d& shift_m) {
  const double before_per_m = landmark.state.inverse_distance_per_m;
  if (!(std::abs(before_per_m) * shift_m.norm() < kFarthestShift)) return;
  landmark.state = landmark.state.seen_from(shift_m);
  const double after_per_m = landmark.state.inverse_distance_per_m;
  landmark.prior_mean_per_m += after_per_m - before_per_m;
  if (landmark.height != kNoHeight && before_per_m > 0.0 && after_per_m > 0.0)
    heights_.edit(landmark.height).tangent *= after_per_m / before_per_m;
}

BearingGraph::Moved BearingGraph::move(const Eigen::VectorXd& step, double stands_below) {
  Moved before;
  before.calibration = calibration_;
  for (std::int32_t i = 0; i < heights_.size(); ++i) before.tangents.push_back(heights_[i].tangent);
  for (LandmarkId i = 0; i < landmarks_.size(); ++i) {
    if (!is_unknown(i)) continue;
    const auto moved = step.segment<2>(first_row(landmarks_[i].block));
    if (moved.cwiseAbs().maxCoeff() < stands_below) continue;
    LandmarkEntry& landmark = landmarks_.edit(i);
    before.landmarks.push_back({i, landmark.state, landmark.prior_mean_per_m});
    move_landmark(landmark, moved, step);
    landmark.moved = true;
  }
  move_heights(step);
  for (PoseId i = 1; i < poses_.size(); ++i) {
    const auto moved = step.segment<3>(first_row(poses_[i].block));
    if (moved.cwiseAbs().maxCoeff() < stands_below) continue;
    PoseEntry& pose = poses_.edit(i);
    before.poses.emplace_back(i, pose.state);
    pose.state = pose.state.moved(moved);
    pose.moved = true;
  }
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (const int row = calibration_row_[i]; row >= 0) {
      calibration_[static_cast<Eigen::Index>(i)] += step[row];
      calibration_moved_ = true;
    }
  return before;
}

void BearingGraph::move_back(const Moved& moved) {
  for (const auto& [id, state] : moved.poses) {
    PoseEntry& pose = poses_.edit(id);
    pose.state = state;
    pose.moved = true;
  }
  for (const auto& [id, state, prior_mean_per_m] : moved.landmarks) {
    LandmarkEntry& landmark = landmarks_.edit(id);
    landmark.state = state;
    landmark.prior_mean_per_m = prior_mean_per_m;
    landmark.moved = true;
  }
  for (std::int32_t i = 0; i < heights_.size(); ++i) {
    heights_.edit(i).tangent = moved.tangents[static_cast<std::size_t>(i)];
    landmarks_.edit(heights_[i].landmark).moved = true;
  }
  calibration_ = moved.calibration;
  calibration_moved_ = true;
}

int BearingGraph::size(Block block) const {
  const BlockEntry& entry = blocks_[block];
  switch (entry.kind) {
    case Kind::calibration:
      return calibration_size_;
    case Kind::pose:
      return entry.id == 0 ? 0 : 3;
    case Kind::landmark:
      return is_unknown(entry.id) ? 2 : 0;
    case Kind::height:
      return heights_[entry.id].elevations > 0 ? 1 : 0;
  }
  return 0;
}

/// Blocks that the next image's terms will involve get high ranks, so that they lie near the root and little is
/// recomputed.
std::uint8_t BearingGraph::rank(Block block) const {
  const BlockEntry& entry = blocks_[block];
  const auto newest = poses_.size() - 1;
  switch (entry.kind) {
    case Kind::calibration:
      return 3;
    case Kind::pose:
      return entry.id == newest ? 2 : 0;
    case Kind::landmark:
      return !landmarks_[entry.id].bearings.empty() && bearings_[landmarks_[entry.id].bearings.back()].pose == newest
                 ? 1
                 : 0;
    case Kind::height:
      return rank(landmarks_[heights_[entry.id].landmark].block);
  }
  return 0;
}

}  // namespace azimuth
