#include "tests/support/narrow_room.hpp"

#include "sim/world/scenario.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {

Run narrow_room(std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "narrow-room";
  scenario.seed = seed;
  Random random(seed, RandomPurpose::scene);
  const Rectangle room{{0.0, 0.0}, {10.0, 8.0}}, driven{{2.0, 2.0}, {8.0, 6.0}};
  constexpr int kCorners = 16;
  constexpr double kShortestLeg_m = 2.0;
  scenario.path = wander(driven, kCorners, kShortestLeg_m, random);
  constexpr int kLandmarks = 15;
  scenario.landmarks = scatter(room, kLandmarks, Spacing{0.6, 0.4}, scenario.path, random);

  SmoothDrive drive;
  drive.speed_m_per_s = 0.2;
  scenario.drive = drive;
  scenario.odometer.lambda_distance_m = 3e-3;
  scenario.odometer.lambda_rotation_rad = 3e-3;
  scenario.odometer.lambda_drift_rad2_per_m = 1e-2;
  scenario.sampling.bearing_period_s = 0.5;
  scenario.sensor.sigma_bearing_rad = degrees_to_rad(2.0);
  scenario.sensor.max_range_m = 6.0;
  scenario.sensor.field_of_view_rad = degrees_to_rad(60.0);
  scenario.sensor.detection_probability = 0.4;

  Run run = simulated_run(scenario);
  run.name += "-" + std::to_string(seed);
  return run;
}

}  // namespace azimuth
