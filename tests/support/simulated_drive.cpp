#include "tests/support/simulated_drive.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

Rig rig_of(const Scenario& scenario) {
  Rig rig;
  rig.camera.sigma_bearing_rad = scenario.sensor.sigma_bearing_rad;
  rig.camera.identities = scenario.sensor.identities;
  rig.camera.field_of_view_rad = scenario.sensor.field_of_view_rad;
  rig.camera.yaw_offset_rad = scenario.sensor.yaw_offset_rad;
  const OdometerSettings& odometer = scenario.odometer;
  rig.odometry.lambda_distance_m = odometer.lambda_distance_m;
  rig.odometry.lambda_rotation_rad = odometer.lambda_rotation_rad;
  rig.odometry.lambda_drift_rad2_per_m = odometer.lambda_drift_rad2_per_m;
  rig.odometry.sigma_lateral_m_per_sqrt_m = odometer.sigma_lateral_m_per_sqrt_m;
  rig.odometry.scale_distance = odometer.scale_distance;
  rig.odometry.scale_turn = odometer.scale_turn;
  rig.odometry.sigma_scale_distance = 0.01;  // the value that `azimuth simulate` writes
  rig.odometry.drift_rad_per_m = odometer.drift_rad_per_m;
  rig.odometry.lag_s = odometer.lag_s;
  return rig;
}

StagedDrive::StagedDrive(std::unique_ptr<Estimator> estimator, const Rig& rig)
    : stage_(std::move(estimator), rig, StageSettings{}) {}

void StagedDrive::run(const World& world, Stamp end) {
  for (; sets_ < world.bearings.size() && world.bearings[sets_].stamp < end; ++sets_) {
    BearingSet set = world.bearings[sets_];
    const Stamp stamp = set.stamp;
    stage_.add(set);
    bool reached = false;  // true after the first reading at or after the stamp of the set
    for (; readings_ < world.odometry.size() && !reached; ++readings_) {
      stage_.add(world.odometry[readings_]);
      reached = world.odometry[readings_].stamp >= stamp;
    }
    while (stage_.advance(last_)) on_estimate(last_);
  }
}

Pose2 true_pose(const World& world, Stamp stamp) {
  const auto after = std::lower_bound(world.truth.begin(), world.truth.end(), stamp,
                                      [](const TruePose& pose, Stamp wanted) { return pose.stamp < wanted; });
  if (after == world.truth.end()) return world.truth.back().T_world_body;
  if (after == world.truth.begin() || after->stamp == stamp) return after->T_world_body;
  const TruePose& before = *(after - 1);
  const double fraction = to_seconds(stamp - before.stamp) / to_seconds(after->stamp - before.stamp);
  return interpolate(before.T_world_body, after->T_world_body, fraction);
}

double position_error_m(const World& world, const Estimate& estimate) {
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  const Pose2 T_world_body = T_world_map * estimate.T_map_body;
  return (T_world_body.position() - true_pose(world, estimate.stamp).position()).norm();
}

}  // namespace azimuth
