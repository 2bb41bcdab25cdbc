#include "tests/support/hindsight_drive.hpp"

#include <optional>

#include "slam/hindsight/make_smoother_estimator.hpp"
#include "tests/support/cpu_time.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

Rig exact_rig_of(const Scenario& scenario) {
  Rig rig = rig_of(scenario);
  rig.odometry.sigma_scale_distance = 0.0;
  return rig;
}

}  // namespace

HindsightDrive::HindsightDrive(const Scenario& scenario, const HindsightSettings& settings)
    : rig_(exact_rig_of(scenario)),
      settings_(settings),
      world_(simulate(scenario)),
      estimator_(make_smoother_estimator(rig_, settings)),
      track_(rig_of(scenario).odometry) {
  online_.reserve(world_.bearings.size());
}

double HindsightDrive::hear_s() {
  const BearingSet& set = world_.bearings[online_.size()];
  while (readings_ < world_.odometry.size() && (track_.empty() || track_.newest() < set.stamp))
    track_.add(world_.odometry[readings_++]);
  const OdometryTrack::Step step = track_.advance_to(set.stamp);
  const double start_s = cpu_time_s();
  estimator_->predict(step.motion);
  estimator_->update(set);
  told_.landmarks.clear();
  told_.accepted.clear();
  estimator_->estimate(told_);
  const double took_s = cpu_time_s() - start_s;
  online_.push_back({set.stamp, told_.T_map_body, told_.pose_covariance, step.T_odom_body});
  return took_s;
}

bool HindsightDrive::start_again() {
  MapSnapshot map;
  if (!estimator_->save_map(map)) return false;
  constexpr double kNotMoved = 1e-4;  // [m] and [rad]
  estimator_ = make_smoother_estimator(
      rig_, settings_,
      {.map = &map, .pose_known = true, .sigma_position_m = kNotMoved, .sigma_heading_rad = kNotMoved});
  return true;
}

HindsightDrive::Errors HindsightDrive::hindsight() const {
  std::vector<PastPose> past;
  estimator_->write_past(past);
  std::vector<EstimateRecord> known;
  for (const PastPose& pose : past) known.push_back({pose.stamp, pose.T_map_body, pose.covariance, {}});
  return errors_of(known);
}

HindsightDrive::Errors HindsightDrive::errors_of(const std::vector<EstimateRecord>& estimates) const {
  std::vector<StampedPose> truth, estimated;
  for (const TruePose& pose : world_.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (const EstimateRecord& estimate : estimates) estimated.push_back({estimate.stamp, estimate.T_map_body});
  const std::vector<PosePair> pairs = pair_with_truth(estimated, truth);
  const std::optional<Pose2> T_world_map = alignment(pairs);
  if (!T_world_map) return {kNotMeasured, kNotMeasured};
  return {error_statistics(pose_errors(pairs, *T_world_map).position_m).rmse, consistency(pairs, estimates).anees};
}

}  // namespace azimuth
