#include "tests/support/cone_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/world/scenario.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr double kRadius_m = 2.5;  // of each half of the eight
constexpr int kFigures = 4;

/// Two circles that touch in the middle; the robot drives the left one counter-clockwise.
Path figures_of_eight() {
  constexpr int kCorners = 48;
  Path path;
  for (int figure = 0; figure < kFigures; ++figure)
    for (const double side : {1.0, -1.0})
      for (int i = 0; i < kCorners; ++i) {
        const double turn = 2.0 * kPi * i / kCorners;
        path.emplace_back(kRadius_m * std::sin(turn), side * kRadius_m * (1.0 - std::cos(turn)));
      }
  path.emplace_back(0.0, 0.0);
  return path;
}

/// One cone within each half of the eight and the others around it, each displaced by up to half a metre.
std::vector<WorldLandmark> eight_cones(Random& random) {
  constexpr std::array<std::array<double, 2>, 8> kPlaces{
      {{0.2, 2.5}, {-0.2, -2.5}, {4.4, 4.6}, {-4.2, 4.2}, {4.6, 0.2}, {-4.5, -0.4}, {4.0, -4.4}, {-4.4, -4.6}}};
  std::vector<WorldLandmark> cones;
  for (std::size_t i = 0; i < kPlaces.size(); ++i)
    cones.push_back({static_cast<Identity>(i),
                     {kPlaces[i][0] + random.uniform(-0.5, 0.5), kPlaces[i][1] + random.uniform(-0.5, 0.5)}});
  return cones;
}

}  // namespace

Run cone_drive(std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "cones";
  scenario.seed = seed;
  scenario.path = figures_of_eight();
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = eight_cones(random);

  SmoothDrive drive;
  drive.speed_m_per_s = 1.0 + random.uniform();
  drive.acceleration_m_per_s2 = 1.0;
  drive.max_turn_rate_rad_per_s = 1.5;
  scenario.drive = drive;
  // The heading of a car comes from its steering angle, which is only roughly known.
  scenario.odometer.lambda_distance_m = 1e-3;
  scenario.odometer.lambda_rotation_rad = 2e-3;
  scenario.odometer.lambda_drift_rad2_per_m = 2e-3;
  scenario.odometer.sigma_lateral_m_per_sqrt_m = 0.01;
  scenario.sampling = {0.02, 1.0 / 30.0, 0.01, 0.1};
  scenario.sensor.sigma_bearing_rad = 0.02;
  scenario.sensor.min_range_m = 0.4;
  scenario.sensor.max_range_m = 8.0;
  scenario.sensor.field_of_view_rad = 140.0 / 180.0 * kPi;
  scenario.sensor.detection_probability = 0.85;

  Run run = simulated_run(scenario);
  run.name += "-" + std::to_string(seed);
  // The simulated sensor names its clutter after a landmark. The clutter is drawn here instead, without names.
  Random clutter(seed + 1000000, RandomPurpose::bearings);
  for (BearingSet& set : run.bearings) {
    for (int i = clutter.poisson(0.1); i > 0; --i) {
      Bearing bearing;
      bearing.azimuth_rad = clutter.uniform(-0.5, 0.5) * scenario.sensor.field_of_view_rad;
      set.bearings.push_back(bearing);
    }
    std::sort(set.bearings.begin(), set.bearings.end(),
              [](const Bearing& a, const Bearing& b) { return a.azimuth_rad < b.azimuth_rad; });
  }
  return run;
}

}  // namespace azimuth
