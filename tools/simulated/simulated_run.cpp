#include "tools/simulated/simulated_run.hpp"

#include <cmath>
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

Run first_seconds(Run run, double most_s) {
  if (run.odometry.empty() || !std::isfinite(most_s)) return run;
  const Stamp begin = run.odometry.front().stamp;
  const auto shorten = [&](auto& samples) {
    std::erase_if(samples, [&](const auto& sample) { return to_seconds(sample.stamp - begin) > most_s; });
  };
  shorten(run.odometry);
  shorten(run.bearings);
  shorten(run.truth);
  return run;
}

}  // namespace azimuth
