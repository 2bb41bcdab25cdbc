#include "sim/world/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/world/driver.hpp"

namespace azimuth {
namespace {

/// Azimuth in the camera's frame; nullopt if the landmark is not visible.
std::optional<double> azimuth_of(const WorldLandmark& landmark, const Pose2& T_world_body,
                                 const BearingSensorSettings& settings) {
  const Eigen::Vector2d p_camera = inverse(T_world_body) * landmark.p_world_landmark_m - settings.position_m;
  const double range_m = p_camera.norm();
  if (range_m < settings.min_range_m || range_m > settings.max_range_m) return std::nullopt;
  const double azimuth_rad = wrap(std::atan2(p_camera.y(), p_camera.x()) - settings.yaw_offset_rad);
  if (std::abs(azimuth_rad) > settings.field_of_view_rad / 2) return std::nullopt;
  return azimuth_rad;
}

Bearing make_bearing(double azimuth_rad, Identity identity) {
  Bearing bearing;
  bearing.azimuth_rad = wrap(azimuth_rad);
  bearing.identity = identity;
  return bearing;
}

/// The identity of a false detection: one that this image does not contain yet, if any is left.
Identity misread(const std::vector<WorldLandmark>& landmarks, const std::vector<Bearing>& seen, Random& random) {
  std::vector<Identity> free;
  for (const WorldLandmark& landmark : landmarks) {
    const auto same = [&](const Bearing& bearing) { return bearing.identity == landmark.identity; };
    if (std::none_of(seen.begin(), seen.end(), same)) free.push_back(landmark.identity);
  }
  return free.empty() ? kUnknownIdentity : free[random.index(free.size())];
}

double sigma(double lambda, double amount) { return std::sqrt(lambda * std::abs(amount)); }

}  // namespace

Pose2 disturbed(const Control& control, const OdometerSettings& settings, Random& random) {
  Control noisy = control;
  noisy.distance_m += random.normal(sigma(settings.lambda_distance_m, control.distance_m));
  noisy.first_turn_rad += random.normal(sigma(settings.lambda_rotation_rad, control.first_turn_rad));
  noisy.second_turn_rad += random.normal(sigma(settings.lambda_rotation_rad, control.second_turn_rad));
  noisy.second_turn_rad += random.normal(sigma(settings.lambda_drift_rad2_per_m, control.distance_m));

  Pose2 T_start_end = displacement(noisy);
  const double slip_m = random.normal(settings.sigma_lateral_m_per_sqrt_m * std::sqrt(std::abs(control.distance_m)));
  T_start_end.x_m -= slip_m * std::sin(noisy.first_turn_rad);
  T_start_end.y_m += slip_m * std::cos(noisy.first_turn_rad);
  return T_start_end;
}

Control raw(const Control& control, const OdometerSettings& settings) {
  const double drift_rad = settings.drift_rad_per_m * control.distance_m;
  return {control.distance_m / settings.scale_distance, control.first_turn_rad / settings.scale_turn,
          (control.second_turn_rad - drift_rad) / settings.scale_turn};
}

BearingSet observe(const std::vector<WorldLandmark>& landmarks, const Pose2& T_world_body,
                   const BearingSensorSettings& settings, Random& random) {
  BearingSet set;
  for (const WorldLandmark& landmark : landmarks) {
    const std::optional<double> azimuth_rad = azimuth_of(landmark, T_world_body, settings);
    if (!azimuth_rad || !random.chance(settings.detection_probability)) continue;
    set.bearings.push_back(make_bearing(*azimuth_rad + random.normal(settings.sigma_bearing_rad), landmark.identity));
  }
  const int clutter = random.poisson(settings.clutter_per_set);
  for (int i = 0; i < clutter; ++i) {
    const double half_rad = settings.field_of_view_rad / 2;
    const double azimuth_rad = random.uniform(-half_rad, half_rad);
    set.bearings.push_back(make_bearing(azimuth_rad, misread(landmarks, set.bearings, random)));
  }
  if (!settings.identities)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  std::sort(set.bearings.begin(), set.bearings.end(),
            [](const Bearing& a, const Bearing& b) { return a.azimuth_rad < b.azimuth_rad; });
  return set;
}

}  // namespace azimuth
