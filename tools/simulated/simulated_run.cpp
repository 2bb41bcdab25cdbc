#include "tools/simulated/simulated_run.hpp"

#include <utility>

#include "sim/world/run_of.hpp"

namespace azimuth {

Run simulated_run(const Scenario& scenario) {
  World world = simulate(scenario);
  Run run = run_of(scenario);
  run.rig_file = "rig.toml";
  run.odometry = std::move(world.odometry);
  run.bearings = std::move(world.bearings);
  for (const TruePose& pose : world.truth) run.truth.push_back({pose.stamp, pose.T_world_body});
  return run;
}

}  // namespace azimuth
