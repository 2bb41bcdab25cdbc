#pragma once
// Randomly drawn worlds, for statistics over many of them.

#include <cstdint>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// A world seen by a camera with a view all round. The rig knows the noise of camera and odometer, but not the
/// odometer's scale errors. Values are uniformly distributed unless stated otherwise:
///  room            6 to 14 m by 60 to 100 % of that
///  path            two laps of a rectangle, 20 to 30 % of the shorter side from the walls; in every second world
///                  random legs of the same total length within this rectangle
///  landmarks       8 to 30, at least 0.6 m apart and 0.4 m off the path; fewer if the room has no more space
///  drive           0.3 to 0.8 m/s, an image every 0.6 to 2 s
///  bearings        0.5 to 2 degrees (standard deviation), range 5 to 10 m, up to 30 % missed, up to 20 % clutter
///  odometry        1 to 5 cm per square root of a metre, 2 to 6 degrees per full turn, 0.5 to 2.5 degrees per
///                  square root of a metre; scale errors of distance and turn of 1 % each (normally distributed)
struct RandomWorld {
  Scenario scenario;           ///< the true world, including the odometer's errors
  double clutter_share = 0.0;  ///< share of all bearings
  Rectangle room;
};
/// The same seed gives the same world.
RandomWorld random_world(std::uint64_t seed);

/// The drive through the world. Its rig assumes that the odometer's scales are correct. Bearings keep their names, for
/// evaluation.
Run run_through(const RandomWorld& world);

}  // namespace azimuth
