#include "tests/support/random_world.hpp"

#include <cmath>
#include <fmt/format.h>

#include "sim/world/run_of.hpp"
#include "sim/world/simulate.hpp"
#include "slam/geometry/angle.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr int kLaps = 2;

double squared(double value) { return value * value; }

double length_m(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// A path of random legs with a total length of about `far_m`.
Path wander_so_far(const Rectangle& area, double far_m, Random& random) {
  const double least_m = 0.5 * (area.high_m - area.low_m).minCoeff();
  const auto most_corners = static_cast<int>(std::ceil(far_m / least_m)) + 1;
  Path path = wander(area, most_corners, least_m, random);
  while (path.size() > 2 && length_m(path) > far_m) path.pop_back();
  return path;
}

void draw_places(RandomWorld& world, bool in_laps, Random& random) {
  const double width_m = random.uniform(6.0, 14.0);
  world.room.high_m = {width_m, width_m * random.uniform(0.6, 1.0)};
  const double from_walls_m = random.uniform(0.2, 0.3) * world.room.high_m.minCoeff();
  const Rectangle driven{world.room.low_m.array() + from_walls_m, world.room.high_m.array() - from_walls_m};
  Scenario& scenario = world.scenario;
  scenario.path = laps_round(driven, kLaps);
  if (!in_laps) scenario.path = wander_so_far(driven, length_m(scenario.path), random);
  const int landmarks = 8 + static_cast<int>(random.index(23));
  scenario.landmarks = scatter(world.room, landmarks, Spacing{0.6, 0.4}, scenario.path, random);
}

void draw_robot(Scenario& scenario, Random& random) {
  SmoothDrive drive;
  drive.speed_m_per_s = random.uniform(0.3, 0.8);
  scenario.drive = drive;
  scenario.sampling.bearing_period_s = random.uniform(0.6, 2.0);
  OdometerSettings& odometer = scenario.odometer;
  odometer.lambda_distance_m = squared(random.uniform(0.01, 0.05));
  odometer.lambda_rotation_rad = squared(degrees_to_rad(random.uniform(2.0, 6.0))) / (2.0 * kPi);
  odometer.lambda_drift_rad2_per_m = squared(degrees_to_rad(random.uniform(0.5, 2.5)));
  odometer.scale_distance = 1.0 + random.normal(0.01);
  odometer.scale_turn = 1.0 + random.normal(0.01);
  BearingSensorSettings& sensor = scenario.sensor;
  sensor.sigma_bearing_rad = degrees_to_rad(random.uniform(0.5, 2.0));
  sensor.max_range_m = random.uniform(5.0, 10.0);
  sensor.detection_probability = random.uniform(0.7, 1.0);
}

/// Mean number of bearings per image of the drive.
double bearings_per_set(const Scenario& scenario) {
  const World world = simulate(scenario);
  double bearings = 0.0;
  for (const BearingSet& set : world.bearings) bearings += static_cast<double>(set.bearings.size());
  return bearings / static_cast<double>(world.bearings.size());
}

}  // namespace

RandomWorld random_world(std::uint64_t seed) {
  RandomWorld world;
  world.scenario.name = fmt::format("world-{}", seed);
  world.scenario.seed = seed;
  Random random(seed, RandomPurpose::scene);
  draw_places(world, seed % 2 == 0, random);
  draw_robot(world.scenario, random);
  world.clutter_share = random.uniform(0.0, 0.2);
  world.scenario.sensor.clutter_per_set =
      world.clutter_share / (1.0 - world.clutter_share) * bearings_per_set(world.scenario);
  return world;
}

Run run_through(const RandomWorld& world) {
  Run run = simulated_run(world.scenario);
  Scenario as_known = world.scenario;
  as_known.odometer.scale_distance = as_known.odometer.scale_turn = 1.0;
  run.rig_toml = rig_toml(as_known);
  return run;
}

}  // namespace azimuth
