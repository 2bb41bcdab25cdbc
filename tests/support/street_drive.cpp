#include "tests/support/street_drive.hpp"

#include <string>

#include "sim/world/scenario.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// A path with legs of whole metres, each at right angles to the previous one.
Path streets(const Rectangle& area, double far_m, Random& random) {
  constexpr int kShortest_m = 2, kLongest_m = 8;
  const Eigen::Vector2d middle = (0.5 * (area.low_m + area.high_m)).array().round();
  Path path{middle};
  double driven_m = 0.0;
  for (int axis = 0; driven_m < far_m; axis = 1 - axis) {
    Eigen::Vector2d next = path.back();
    while (next == path.back() || next[axis] < area.low_m[axis] || next[axis] > area.high_m[axis]) {
      const int leg_m = kShortest_m + static_cast<int>(random.index(kLongest_m - kShortest_m + 1));
      next[axis] = path.back()[axis] + (random.uniform() < 0.5 ? -leg_m : leg_m);
    }
    driven_m += (next - path.back()).norm();
    path.push_back(next);
  }
  return path;
}

}  // namespace

Run street_drive(std::uint64_t seed) {
  constexpr int kStops = 300, kLandmarks = 140;
  Scenario scenario;
  scenario.name = "streets";
  scenario.seed = seed;
  Random random(seed, RandomPurpose::scene);
  const Rectangle town{{0.0, 0.0}, {28.0, 24.0}}, driven{{2.0, 2.0}, {26.0, 22.0}};
  scenario.path = streets(driven, kStops, random);
  scenario.landmarks = scatter(town, kLandmarks, Spacing{0.6, 0.3}, scenario.path, random);

  scenario.drive = StepDrive{.steps = kStops, .sigma_aim_m = 0.02, .sigma_heading_rad = 0.02};
  scenario.odometer.lambda_distance_m = 2e-3;
  scenario.odometer.lambda_rotation_rad = 5e-4;
  scenario.odometer.lambda_drift_rad2_per_m = 2e-4;
  scenario.odometer.sigma_lateral_m_per_sqrt_m = 0.045;
  scenario.sampling.bearing_period_s = 1.0;
  scenario.sensor.sigma_bearing_rad = 0.0035;
  scenario.sensor.max_range_m = 5.0;
  scenario.sensor.field_of_view_rad = kPi;

  Run run = simulated_run(scenario);
  run.name += "-" + std::to_string(seed);
  return run;
}

}  // namespace azimuth
