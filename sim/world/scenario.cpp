#include "sim/world/scenario.hpp"

namespace azimuth {
namespace {

constexpr Sampling kOnceAStop{1.0, 1.0, 0.0, 1.0};

const Rectangle kLabRoom{{0.5, 0.5}, {13.5, 9.5}};
const Rectangle kLabBlock{{2.0, 2.0}, {12.0, 8.0}};
constexpr int kStopsALap = 32;  // Round that block, one metre apart

/// An indoor robot with good wheels and a poor heading.
OdometerSettings indoor_odometer() {
  OdometerSettings odometer;
  odometer.lambda_distance_m = 4e-4;         // (2 cm)^2 / m
  odometer.lambda_rotation_rad = 4.3633e-4;  // (3 deg)^2 / 360 deg
  odometer.lambda_drift_rad2_per_m = 1e-3;   // (1.8 deg)^2 / m
  return odometer;
}

Scenario smooth_scenario(std::string name, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = std::move(name);
  scenario.seed = seed;
  scenario.drive = SmoothDrive{};
  scenario.odometer = indoor_odometer();
  scenario.sensor.sigma_bearing_rad = 0.0174533;  // 1 deg
  return scenario;
}

int laps_or(int laps, int own) { return laps > 0 ? laps : own; }

}  // namespace

Scenario coloured_lab(std::uint64_t seed, int laps) {
  Scenario scenario;
  scenario.name = "coloured-lab";
  scenario.seed = seed;
  scenario.path = laps_round(kLabBlock, laps);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = scatter(kLabRoom, 24, Spacing{0.8, 0.4}, scenario.path, random);
  scenario.sensor.min_range_m = 0.7;  // Nearer landmarks are in the mirror's masked inner disc
  StepDrive drive;
  drive.steps += (laps - 1) * kStopsALap;
  scenario.drive = drive;
  scenario.sampling = kOnceAStop;
  return scenario;
}

Scenario lab(std::uint64_t seed, int laps) {
  Scenario scenario = smooth_scenario("lab", seed);
  scenario.path = laps_round(kLabBlock, laps);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = scatter(kLabRoom, 24, Spacing{}, scenario.path, random);
  scenario.sensor.max_range_m = 5.0;
  scenario.sensor.detection_probability = 0.9;
  return scenario;
}

Scenario hall(std::uint64_t seed, int laps) {
  Scenario scenario = smooth_scenario("hall", seed);
  scenario.path = laps_round({{5.0, 5.0}, {19.0, 19.0}}, laps);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = line_walls({{0.0, 0.0}, {24.0, 24.0}}, 3.0, 1.5, random);
  scenario.sensor.max_range_m = 12.0;
  scenario.sensor.detection_probability = 0.9;
  return scenario;
}

Scenario corridor(std::uint64_t seed, int laps) {
  Scenario scenario = smooth_scenario("corridor", seed);
  scenario.path = there_and_back({1.0, 1.5}, {39.0, 1.5}, laps);
  Random random(seed, RandomPurpose::scene);
  scenario.landmarks = line_walls({{0.0, 0.0}, {40.0, 3.0}}, 2.0, 0.3, random);
  scenario.sensor.max_range_m = 10.0;
  scenario.sensor.field_of_view_rad = kPi / 2;
  scenario.sensor.detection_probability = 0.9;
  return scenario;
}

Scenario scattered(std::uint64_t seed, int laps) {
  constexpr int kLegsPerLap = 12;
  const Rectangle room{{0.0, 0.0}, {20.0, 20.0}};
  const Rectangle driven{{2.0, 2.0}, {18.0, 18.0}};
  Scenario scenario = smooth_scenario("scattered", seed);
  Random random(seed, RandomPurpose::scene);
  scenario.path = wander(driven, kLegsPerLap * laps + 1, 5.0, random);
  scenario.landmarks = scatter(room, 40, Spacing{1.0, 0.5}, scenario.path, random);
  scenario.sensor.max_range_m = 8.0;
  scenario.sensor.detection_probability = 0.9;
  return scenario;
}

std::optional<Scenario> scenario_named(std::string_view name, std::uint64_t seed, int laps) {
  if (name == "coloured-lab") return coloured_lab(seed, laps_or(laps, 1));
  if (name == "lab") return lab(seed, laps_or(laps, 3));
  if (name == "hall") return hall(seed, laps_or(laps, 2));
  if (name == "corridor") return corridor(seed, laps_or(laps, 1));
  if (name == "scattered") return scattered(seed, laps_or(laps, 1));
  return std::nullopt;
}

}  // namespace azimuth
