#include "sim/world/run_of.hpp"

#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

constexpr double kMeasured = 0.01;  // Uncertainty of a tape measurement

/// A number as a TOML float: with a decimal point or an exponent.
std::string number(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string camera_toml(const BearingSensorSettings& sensor) {
  const std::string position =
      sensor.position_m.isZero(0.0)
          ? std::string()
          : fmt::format("position_m = [{}, {}]\n", number(sensor.position_m.x()), number(sensor.position_m.y()));
  return "front_end = \"bearings\"\n\n[camera]\nmodel = \"bearings\"\n" +
         fmt::format("sigma_bearing_rad = {}\nidentities = {}\nfield_of_view_rad = {}\nyaw_offset_rad = {}\n",
                     number(sensor.sigma_bearing_rad), sensor.identities, number(sensor.field_of_view_rad),
                     number(sensor.yaw_offset_rad)) +
         position;
}

std::string odometry_toml(const OdometerSettings& odometer) {
  std::string text = "[odometry]\nkind = \"wheel_pose\"\n";
  const auto add = [&](const char* key, double value) { text += fmt::format("{} = {}\n", key, number(value)); };
  add("lambda_distance_m", odometer.lambda_distance_m);
  add("lambda_rotation_rad", odometer.lambda_rotation_rad);
  add("lambda_drift_rad2_per_m", odometer.lambda_drift_rad2_per_m);
  add("sigma_lateral_m_per_sqrt_m", odometer.sigma_lateral_m_per_sqrt_m);
  add("scale_distance", odometer.scale_distance);
  add("scale_turn", odometer.scale_turn);
  add("drift_rad_per_m", odometer.drift_rad_per_m);
  add("sigma_scale_distance", kMeasured);
  add("lag_s", odometer.lag_s);
  return text;
}

}  // namespace

std::string rig_toml(const Scenario& scenario) { return rig_toml(scenario, camera_toml(scenario.sensor)); }

std::string rig_toml(const Scenario& scenario, std::string_view camera_text) {
  return fmt::format("# Simulated: world \"{}\", seed {}.\n{}\n", scenario.name, scenario.seed, camera_text) +
         odometry_toml(scenario.odometer);
}

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
