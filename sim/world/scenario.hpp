#pragma once
// Ready-made worlds. Each is a plain value that a test may modify before simulate().

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/driver.hpp"
#include "sim/world/scene.hpp"
#include "sim/world/sensors.hpp"

namespace azimuth {

/// Sampling instants, as multiples of the drive's tick (rounded, at least one tick).
struct Sampling {
  double odometry_period_s = 0.1;
  double bearing_period_s = 0.2;
  double bearing_phase_s = 0.03;  ///< Offset from the odometry readings: a camera does not know the odometer's clock
  double truth_period_s = 0.2;
};

struct Scenario {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<WorldLandmark> landmarks;
  Path path;
  DriveSettings drive;
  OdometerSettings odometer;
  BearingSensorSettings sensor;
  Sampling sampling;
};

/// mathematics part IV, "coloured": a 14 x 10 m lab, 24 landmarks visible from 0.7 to 6 m, 36 stops about 1 m apart
/// round a block (32 more for each further lap), bearings of 1.5 deg, odometry noise set 1. Stamps are one second
/// apart.
Scenario coloured_lab(std::uint64_t seed, int laps = 1);

/// The lab of coloured_lab() with a typical robot: smooth driving at 0.5 m/s, 10 Hz odometry that drifts on straights,
/// 5 Hz bearings of 1 deg, most landmarks visible most of the time.
Scenario lab(std::uint64_t seed, int laps = 3);

/// A 24 x 24 m hall with landmarks along its walls, visible up to 12 m.
Scenario hall(std::uint64_t seed, int laps = 2);

/// A 40 x 3 m corridor, there and back, with a camera that looks ahead only (90 deg): poor parallax.
Scenario corridor(std::uint64_t seed, int laps = 1);

/// Landmarks at random in 20 x 20 m and a path of random legs.
Scenario scattered(std::uint64_t seed, int laps = 1);

inline constexpr std::array<std::string_view, 5> kScenarioNames{"coloured-lab", "lab", "hall", "corridor", "scattered"};

/// The scenario with a name of kScenarioNames; laps 0 means the scenario's own number.
std::optional<Scenario> scenario_named(std::string_view name, std::uint64_t seed, int laps = 0);

}  // namespace azimuth
