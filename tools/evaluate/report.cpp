#include "tools/evaluate/report.hpp"

#include <fmt/format.h>
#include <string_view>

namespace azimuth {
namespace {

/// Advice on how to speed up the front end.
std::string_view lighter_front_end(std::string_view front_end) {
  if (front_end == "sift") return "a smaller sift.side_px or sift.target_count makes looking at an image quicker";
  return "smaller images make looking at one quicker: choose a smaller size at the camera";
}

std::string_view lighter_estimator(std::string_view estimator) {
  if (estimator == "fastslam") return "fewer fastslam.particles make a step quicker";
  if (estimator == "lamp_ekf") return "a smaller lamp_ekf.max_landmarks makes a step quicker";
  if (estimator == "smoother")
    return "a smaller smoother.max_keyframes, or fewer smoother.members where bearings have no names, make a step "
           "quicker";
  return "a smaller ekf.max_landmarks makes a step quicker";
}

template <class Pose>
std::vector<StampedPose> poses(const std::vector<EstimateRecord>& estimates, Pose pose) {
  std::vector<StampedPose> result;
  result.reserve(estimates.size());
  for (const EstimateRecord& estimate : estimates) result.push_back({estimate.stamp, estimate.*pose});
  return result;
}

/// Raw odometry at the instants of the estimates, so that both are evaluated at the same instants.
std::vector<StampedPose> at_estimates(const ReplayRecord& record) {
  std::vector<StampedPose> result;
  for (const EstimateRecord& estimate : record.estimates)
    if (const auto pose = pose_at(record.raw_odometry, estimate.stamp)) result.push_back({estimate.stamp, *pose});
  return result;
}

struct AlignedErrors {
  ErrorStatistics position_m;
  std::optional<Pose2> T_world_estimated;
};

AlignedErrors aligned_errors(const std::vector<StampedPose>& trajectory, const std::vector<StampedPose>& truth) {
  const std::vector<PosePair> pairs = pair_with_truth(trajectory, truth);
  AlignedErrors result;
  result.T_world_estimated = alignment(pairs);
  if (result.T_world_estimated)
    result.position_m = error_statistics(pose_errors(pairs, *result.T_world_estimated).position_m);
  return result;
}

/// The first pair is always kept, because consistency() takes the others relative to it.
void judge_tracking(const ReplayRecord& record, const std::vector<PosePair>& pairs, Report& report) {
  if (record.healths.size() != record.estimates.size() || pairs.empty()) return;
  std::vector<PosePair> tracking{pairs.front()};
  for (std::size_t i = 1; i < pairs.size(); ++i)
    if (record.healths[pairs[i].index].health == Health::tracking) tracking.push_back(pairs[i]);
  report.tracking_consistency = consistency(tracking, record.estimates);
}

void judge_poses(const ReplayRecord& record, Report& report) {
  const std::vector<PosePair> pairs =
      pair_with_truth(poses(record.estimates, &EstimateRecord::T_map_body), record.truth);
  report.T_world_map = alignment(pairs);
  if (!report.T_world_map) return;
  const PoseErrors errors = pose_errors(pairs, *report.T_world_map);
  report.position_m = error_statistics(errors.position_m);
  report.heading_rad = error_statistics(errors.heading_rad);
  report.consistency = consistency(pairs, record.estimates);
  judge_tracking(record, pairs, report);
}

void judge_hindsight(const ReplayRecord& record, Report& report) {
  if (record.past.empty()) return;
  HindsightReport& hindsight = report.hindsight.emplace();
  const std::vector<PosePair> pairs = pair_with_truth(poses(record.past, &EstimateRecord::T_map_body), record.truth);
  const std::optional<Pose2> T_world_map = alignment(pairs);
  if (!T_world_map) return;
  const PoseErrors errors = pose_errors(pairs, *T_world_map);
  hindsight.position_m = error_statistics(errors.position_m);
  hindsight.heading_rad = error_statistics(errors.heading_rad);
  hindsight.consistency = consistency(pairs, record.past);
  if (!record.natural_features) hindsight.map = map_error(record.map, record.true_landmarks, *T_world_map);
}

void judge_odometry(const ReplayRecord& record, Report& report) {
  if (record.raw_odometry.empty()) return;
  const AlignedErrors calibrated = aligned_errors(poses(record.estimates, &EstimateRecord::T_odom_body), record.truth);
  report.odometry_m = calibrated.position_m;
  report.T_world_odom = calibrated.T_world_estimated;
  report.odometry_raw_m = aligned_errors(at_estimates(record), record.truth).position_m;
}

double median_period_us(const std::vector<EstimateRecord>& estimates) {
  std::vector<double> periods_us;
  for (std::size_t i = 1; i < estimates.size(); ++i)
    periods_us.push_back(1e6 * to_seconds(estimates[i].stamp - estimates[i - 1].stamp));
  return time_statistics(periods_us).median_us;
}

void judge_map(const ReplayRecord& record, Report& report) {
  report.map.landmarks = record.map.size();
  report.map.true_landmarks = record.true_landmarks.size();
  report.settled_landmarks = record.settled_landmarks;
  report.natural_features = record.natural_features;
  if (!report.T_world_map || record.natural_features) return;
  report.map = map_error(record.map, record.true_landmarks, *report.T_world_map);
  report.named_map = named_map_error(record.map, record.true_landmarks, *report.T_world_map);
  report.space_map = space_map_error(record.map, record.true_landmarks, *report.T_world_map);
}

}  // namespace

Report evaluate(const ReplayRecord& record) {
  Report report;
  report.run = record.run;
  report.estimator = record.estimator;
  report.front_end = record.front_end;
  report.seed = record.seed;
  report.health = record.health;
  report.digest = record.digest;
  report.steps = record.estimates.size();
  report.input_trouble = record.input_trouble;
  report.incomplete = record.incomplete;
  report.health_over_time = health_report(record.healths, record.driven);
  judge_poses(record, report);
  judge_odometry(record, report);
  judge_map(record, report);
  judge_hindsight(record, report);
  if (!record.estimates.empty())
    report.two_sigma_final = 2.0 * record.estimates.back().covariance.diagonal().cwiseSqrt();
  report.association = record.association;
  report.association.sightings = sighting_errors(record.sightings, record.truth, record.p_body_camera_m);
  report.images = record.images;
  report.decode = time_statistics(record.times.decode_us);
  report.detect = time_statistics(record.times.detect_us);
  report.update = time_statistics(record.times.update_us);
  report.step = time_statistics(record.times.step_us);
  report.image_period_us = median_period_us(record.estimates);
  report.peak_memory_mb = record.peak_memory_mb;
  report.resident_memory_mb = record.resident_memory_mb;
  return report;
}

std::string why_too_slow(const Report& report) {
  if (!(report.step.mean_us > report.image_period_us)) return "";
  const bool by_images = report.detect.mean_us > 0.5 * report.step.mean_us;
  return fmt::format(
      "a step took {:.1f} ms on the average and images came every {:.1f} ms: a daemon on this machine would leave "
      "images out; {}",
      1e-3 * report.step.mean_us, 1e-3 * report.image_period_us,
      by_images ? lighter_front_end(report.front_end) : lighter_estimator(report.estimator));
}

}  // namespace azimuth
