// SmootherEstimator: what it says of robot and map.

#include <Eigen/Core>
#include <cmath>

#include "slam/hindsight/by_scale.hpp"
#include "slam/hindsight/graph_map.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr double kExpectedWithin_sigmas = 3.0;
constexpr int kSlipsUntilLost = 3;  // in a row: wheels that slip do not so with every image

}  // namespace

void SmootherEstimator::estimate(Estimate& out) const {
  write(belief_, hearing_.path_m, out);
  const Smoother& smoother = mapper_->smoother();
  for (const HindsightLandmark& landmark : settled_landmarks()) {
    const Eigen::Vector2d p_map = smoother.graph().landmark(landmark.in_graph).p_map();
    out.landmarks.push_back(
        {.id = landmark.id,
         .identity = landmark.identity,
         .p_map_landmark_m = p_map,
         .covariance_m2 = covariances_.of(landmark, smoother) + by_scale(settings_.sigma_scale_distance, p_map)});
  }
  for (const HeardBearing& bearing : mapper_->heard())
    if (bearing.agrees && bearing.of_last_image)
      out.accepted.push_back(
          {bearing.landmark_id, wrap(bearing.azimuth_rad - rig_.camera.yaw_offset_rad), bearing.sigma_rad});
}

void SmootherEstimator::look_ahead(const Motion& motion, Estimate& out) const {
  const MovedPose moved = apply(belief_.T_map_body, motion);
  write({moved.T_map_body, moved.G * belief_.covariance * moved.G.transpose() + moved.noise},
        hearing_.path_m + motion.path_m, out);
}

void SmootherEstimator::write(const PoseGaussian& belief, double path_m, Estimate& out) const {
  const Judgement judgement = judged(belief.covariance, path_m);
  out.T_map_body = belief.T_map_body;
  out.pose_covariance = belief.covariance;
  out.pose_covariance.topLeftCorner<2, 2>() += by_scale(settings_.sigma_scale_distance, belief.T_map_body.position());
  out.association = counts_;
  out.health = judgement.health;
  out.reason = judgement.reason;
}

Judgement SmootherEstimator::judged(const Eigen::Matrix3d& covariance, double path_m) const {
  if (const auto judgement = lost_.judgement()) return *judgement;
  if (slips_in_row_ >= kSlipsUntilLost)
    return {Health::lost, "odometry and images contradict each other again and again"};
  Evidence evidence = hearing_.evidence(covariance, path_m);
  evidence.landmarks = count_settled();
  const Judgement judgement = judge(evidence, settings_.health);
  if (judgement.health != Health::tracking) return judgement;
  return mapper_->doubt().value_or(judgement);
}

void SmootherEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  const Smoother& smoother = mapper_->smoother();
  const SmoothedPose robot(belief_.T_map_body);
  for (const HindsightLandmark& landmark : settled_landmarks()) {
    const SmoothedLandmark& at = smoother.graph().landmark(landmark.in_graph);
    SeenAzimuth seen;
    if (!see(robot, at, 0.0, seen)) continue;
    // What robot and landmark have in common is left out, which makes the gate rather too wide.
    const Eigen::Vector2d by_position = robot.to_map(seen.by_pose.head<2>());
    const Eigen::Vector3d by_pose(by_position.x(), by_position.y(), seen.by_pose.z());
    const double variance = by_pose.dot(belief_.covariance * by_pose) +
                            by_position.dot(covariances_.of(landmark, smoother) * by_position) +
                            rig_.camera.sigma_bearing_rad * rig_.camera.sigma_bearing_rad;
    out.push_back({.landmark = landmark.id,
                   .kind = landmark.kind,
                   .azimuth_rad = wrap(seen.azimuth_rad - rig_.camera.yaw_offset_rad),
                   .gate_rad = kExpectedWithin_sigmas * std::sqrt(variance),
                   .sigma_rad = std::sqrt(variance)});
  }
}

bool SmootherEstimator::save_map(MapSnapshot& out) const {
  out.clear();
  if (judged(belief_.covariance, hearing_.path_m).health == Health::lost) return false;
  const std::vector<HindsightLandmark> settled = settled_landmarks();
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
  for (PastPose& past : out)
    past.covariance.topLeftCorner<2, 2>() += by_scale(settings_.sigma_scale_distance, past.T_map_body.position());
  return true;
}

}  // namespace azimuth
