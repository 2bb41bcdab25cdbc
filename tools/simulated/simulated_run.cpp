#include "tools/simulated/simulated_run.hpp"

#include <cmath>
#include <utility>

#include "sim/world/rig_toml.hpp"

namespace azimuth {
namespace {

double rounded(double length_m) { return std::round(length_m * 1e6) / 1e6; }

}  // namespace

Run simulated_run(const Scenario& scenario) {
  World world = simulate(scenario);
  Run run;
  run.name = scenario.name;
  run.rig_toml = rig_toml(scenario);
  run.rig_file = "rig.toml";
  run.odometry = std::move(world.odometry);
  run.bearings = std::move(world.bearings);
  for (const TruePose& pose : world.truth) run.truth.push_back({pose.stamp, pose.T_world_body});
  for (const WorldLandmark& landmark : scenario.landmarks) {
    TrueLandmark& true_landmark = run.landmarks.emplace_back();
    true_landmark.identity = landmark.identity;
    true_landmark.x_m = rounded(landmark.p_world_landmark_m.x());
    true_landmark.y_m = rounded(landmark.p_world_landmark_m.y());
  }
  return run;
}

}  // namespace azimuth
