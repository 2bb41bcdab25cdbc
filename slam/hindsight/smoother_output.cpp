// SmootherEstimator: its output of pose, map and health.

#include <Eigen/Core>
#include <cmath>

#include "slam/hindsight/graph_map.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kExpectedWithin_sigmas = 3.0;
constexpr double kPlaceKnown = 0.1;  // relative standard deviation of a distance

/// Covariance of the pose due to a lag between images and odometry. It is unknown whether images or odometry are late,
/// so the robot may be off by the way that it drives in this time.
template <typename Poses>
Eigen::Matrix3d by_lag(const Poses& poses, std::size_t newest, double lag_s) {
  const Stamp since = poses[newest].stamp - duration_from_seconds(lag_s);
  std::size_t first = newest;
  while (first > 0 && poses[first].stamp > since) --first;
  const double lasted_s = to_seconds(poses[newest].stamp - poses[first].stamp);
  if (!(lasted_s > 0.0)) return Eigen::Matrix3d::Zero();
  Eigen::Vector3d way = poses[newest].T_map_body.vector() - poses[first].T_map_body.vector();
  way.z() = wrap(way.z());
  way *= lag_s / std::max(lag_s, lasted_s);
  return way * way.transpose();
}

}  // namespace

void SmootherEstimator::estimate(Estimate& out) const {
  write(belief_, recognition_.path_m, out);
  const Smoother& smoother = mapper_->smoother();
  for (const HindsightLandmark& landmark : settled_landmarks()) {
    const Eigen::Vector2d p_map = smoother.graph().landmark(landmark.in_graph).p_map();
    out.landmarks.push_back(
        {.id = landmark.id,
         .identity = landmark.identity,
         .p_map_landmark_m = p_map,
         .covariance_m2 = covariances_.of(landmark, smoother) + by_scale(settings_.sigma_scale_distance, p_map)});
  }
  for (const UsedBearing& bearing : mapper_->heard())
    if (bearing.agrees && bearing.of_last_image && !held_back_)
      out.accepted.push_back(
          {bearing.landmark_id, wrap(bearing.azimuth_rad - rig_.camera.yaw_offset_rad), bearing.sigma_rad});
}

void SmootherEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  const MovedPose moved = apply(belief_.T_map_body, motion);
  write({moved.T_map_body, moved.G * belief_.covariance * moved.G.transpose() + moved.noise},
        recognition_.path_m + motion.path_m, out);
}

void SmootherEstimator::write(const PoseGaussian& belief, double path_m, Estimate& out) const {
  const Judgement judgement = judged(belief.covariance, path_m);
  out.T_map_body = belief.T_map_body;
  out.pose_covariance = belief.covariance;
  out.pose_covariance.topLeftCorner<2, 2>() += by_scale(settings_.sigma_scale_distance, belief.T_map_body.position());
  if (const double lag_s = doubted_lag_s(); lag_s > 0.0 && !latest_.empty())
    out.pose_covariance += by_lag(latest_, latest_.size() - 1, lag_s);
  out.association = counts_;
  out.health = judgement.health;
  out.reason = judgement.reason;
}

double SmootherEstimator::doubted_lag_s() const {
  const std::optional<RigBelief> rig = mapper_->rig();
  if (!rig || !rig->is_doubted(calibration::lag)) return 0.0;
  return std::abs(mapper_->calibration()[calibration::lag]);
}

Judgement SmootherEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  if (lost_.is_searched_for() && rest_.is_carried())
    return {Health::lost, "landmarks are seen to move while odometry stands still: lifted, or no encoder counts"};
  if (slips_in_row_ >= kSlipsUntilLost)
    return {Health::lost, "odometry and images contradict each other again and again"};
  if (const auto judgement = lost_.judgement()) return *judgement;
  Evidence evidence = recognition_.evidence(covariance, path_m);
  evidence.landmarks = count_settled();
  evidence.map_reach_m = map_reach_m_;
  const Judgement judgement = judge(evidence, settings_.health);
  if (judgement.health != Health::tracking) return judgement;
  return mapper_->doubt().value_or(judgement);
}

/// Predicts a landmark's azimuth; empty when the robot is at the landmark or the landmark at infinity.
std::optional<SmootherEstimator::Prediction> SmootherEstimator::predict(const HindsightLandmark& landmark) const {
  const Smoother& smoother = mapper_->smoother();
  const SmoothedPose robot = smoother.graph().camera_at(SmoothedPose(belief_.T_map_body));
  SeenAzimuth seen;
  if (!see(robot, smoother.graph().landmark(landmark.in_graph), 0.0, seen)) return std::nullopt;
  const Eigen::Vector2d by_position = robot.to_map(seen.by_pose.head<2>());
  const Eigen::Vector3d by_pose(by_position.x(), by_position.y(), seen.by_pose.z());
  return Prediction{.azimuth_rad = wrap(seen.azimuth_rad - mapper_->calibration()[calibration::yaw]),
                    .variance_rad2 = by_pose.dot(belief_.covariance * by_pose) +
                                     by_position.dot(covariances_.of(landmark, smoother) * by_position)};
}

void SmootherEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  const double sigma_bearing_rad = rig_.camera.sigma_bearing_rad;
  for (const HindsightLandmark& landmark : settled_landmarks()) {
    const std::optional<Prediction> seen = predict(landmark);
    if (!seen) continue;
    const double sigma_rad = std::sqrt(seen->variance_rad2 + sigma_bearing_rad * sigma_bearing_rad);
    out.push_back({.landmark = landmark.id,
                   .kind = landmark.kind,
                   .azimuth_rad = wrap(seen->azimuth_rad - rig_.camera.yaw_offset_rad),
                   .gate_rad = kExpectedWithin_sigmas * sigma_rad,
                   .sigma_rad = sigma_rad});
  }
}

RigFinding SmootherEstimator::rig_finding() const {
  const std::optional<RigBelief> rig = mapper_->rig();
  if (!rig) return {};
  RigFinding finding{.bearing_noise = rig->bearing_noise, .odometry_noise = rig->odometry_noise};
  if (!rig->doubts_any()) return finding;
  const Calibration error = mapper_->calibration(), sigma = mapper_->calibration_sigma();
  const auto tell = [&](int which, std::optional<RigFinding::Value>& value) {
    if (rig->is_doubted(which)) value = {error[which], sigma[which]};
  };
  tell(calibration::yaw, finding.yaw_offset_rad);
  tell(calibration::scale_turn, finding.scale_turn);
  tell(calibration::drift, finding.drift_rad_per_m);
  tell(calibration::lag, finding.lag_s);
  tell(calibration::camera_x, finding.camera_ahead_m);
  tell(calibration::camera_y, finding.camera_left_m);
  return by_keys(rig_, finding, error[calibration::scale_turn]);
}

/// Whether the landmark's distance is known well enough to save it. Until then, the error of the landmark is Gaussian
/// only in a chart whose origin is the place where the landmark was seen first, and a saved map does not contain this
/// chart. A start from a map with such a landmark would make the robot's pose too certain; without the landmark, the
/// next drive maps it anew.
bool SmootherEstimator::has_place(const HindsightLandmark& landmark) const {
  const BearingGraph& graph = mapper_->smoother().graph();
  const double known_per_m = kPlaceKnown * graph.landmark(landmark.in_graph).inverse_distance_per_m;
  return landmark.recalled || graph.told_information(landmark.in_graph) * known_per_m * known_per_m > 1.0;
}

bool SmootherEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  if (judged(belief_.covariance, recognition_.path_m).health == Health::lost) return false;
  std::vector<HindsightLandmark> settled = settled_landmarks();
  std::erase_if(settled, [this](const HindsightLandmark& landmark) { return !has_place(landmark); });
  if (settled.empty()) return false;
  std::vector<LandmarkId> in_graph;
  for (const HindsightLandmark& landmark : settled) {
    in_graph.push_back(landmark.in_graph);
    out.landmarks.push_back(
        {.id = landmark.id, .identity = landmark.identity, .kind = landmark.kind, .sightings = landmark.sightings});
  }
  if (!place_by_graph(*mapper_, in_graph, out)) return false;
  out.names = settings_.named ? MapNames::sensor : MapNames::none;
  out.next_id = mapper_->next_id();
  return true;
}

bool SmootherEstimator::write_path(std::vector<PathPose>& out) const {
  image_poses_.write_path(*mapper_, out);
  return true;
}

void SmootherEstimator::conclude() {
  mapper_->conclude();
  covariances_.forget();
}

bool SmootherEstimator::write_past(std::vector<PastPose>& out) const {
  image_poses_.write(*mapper_, out);
  const double lag_s = doubted_lag_s();
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (lag_s > 0.0) out[i].covariance += by_lag(out, i, lag_s);
    out[i].covariance.topLeftCorner<2, 2>() += by_scale(settings_.sigma_scale_distance, out[i].T_map_body.position());
  }
  return true;
}

}  // namespace azimuth
