#include "sim/world/run_of.hpp"

#include <cmath>

#include "sim/world/rig_toml.hpp"

namespace azimuth {

double recorded(double value) { return std::round(value * 1e6) / 1e6; }

Run run_of(const Scenario& scenario) {
  Run run;
  run.name = scenario.name;
  run.rig_toml = rig_toml(scenario);
  for (const WorldLandmark& landmark : scenario.landmarks) {
    TrueLandmark& true_landmark = run.landmarks.emplace_back();
    true_landmark.identity = landmark.identity;
    true_landmark.x_m = recorded(landmark.p_world_landmark_m.x());
    true_landmark.y_m = recorded(landmark.p_world_landmark_m.y());
  }
  return run;
}

}  // namespace azimuth
