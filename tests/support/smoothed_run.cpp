#include "tests/support/smoothed_run.hpp"

#include <functional>

#include "tests/support/cpu_time.hpp"
#include "tests/support/run_steps.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

/// The pose of an image relative to the preceding pose in the graph.
struct Behind {
  PoseNumber anchor;
  Motion motion;
};

}  // namespace

KnownNamesSettings settings_for(const Rig& rig, const SmootherSettings& settings) {
  KnownNamesSettings result;
  result.smoother = settings;
  result.sigma_bearing_rad = rig.camera.sigma_bearing_rad;
  result.floors.distance_m = rig.odometry.floor_distance_m;
  result.floors.rotation_rad = rig.odometry.floor_rotation_rad;
  return result;
}

SmoothedRun smoothed_run(const Run& run, const Rig& rig, const KnownNamesSettings& settings,
                         const std::function<void(const KnownNames&)>& every_set) {
  SmoothedRun result;
  KnownNames names(settings);
  std::vector<Behind> behind;
  for_each_step(run, rig, [&](const BearingSet& set, const OdometryTrack::Step& step) {
    const double start_s = cpu_time_s();
    names.predict(step.motion);
    const bool used = names.update(set);
    if (names.is_full()) names.forget(names.least_worth());
    const Eigen::Matrix3d covariance = names.covariance();
    if (used) {
      result.step_us.push_back(1e6 * (cpu_time_s() - start_s));
      result.damped += static_cast<std::size_t>(names.last_outcome().damped);
      result.not_converged += names.last_outcome().converged ? 0 : 1;
    }
    result.online.push_back({set.stamp, names.pose(), covariance, step.T_odom_body});
    behind.push_back({names.anchor(), names.since_anchor()});
    if (every_set) every_set(names);
  });
  const Smoother& smoother = names.smoother();
  for (std::size_t i = 0; i < behind.size(); ++i) {
    const ThinnedPath::Told start = names.past(behind[i].anchor);
    const MovedPose moved = apply(start.T_map_body, behind[i].motion);
    result.smoothed.push_back({result.online[i].stamp, moved.T_map_body,
                               moved.G * start.covariance * moved.G.transpose() + moved.noise,
                               result.online[i].T_odom_body});
  }
  result.poses = smoother.graph().poses();
  result.landmarks = smoother.graph().landmarks();
  result.bearings = smoother.graph().bearings();
  result.energy = smoother.energy();
  return result;
}

RunError run_error(const Run& run, const std::vector<EstimateRecord>& estimates) {
  std::vector<StampedPose> truth, estimated;
  for (const TruthPose& pose : run.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (const EstimateRecord& estimate : estimates) estimated.push_back({estimate.stamp, estimate.T_map_body});
  const std::vector<PosePair> pairs = pair_with_truth(estimated, truth);
  const auto T_world_map = alignment(pairs);
  if (!T_world_map) return {kNotMeasured, kNotMeasured};
  const PoseErrors errors = pose_errors(pairs, *T_world_map);
  return {error_statistics(errors.position_m).rmse, consistency(pairs, estimates).anees};
}

}  // namespace azimuth
