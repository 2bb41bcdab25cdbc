#pragma once
// Worlds of which nothing is known beforehand but how they are drawn, for statistics over many of them.

#include <cstdint>

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// Seen all round by a camera whose noise the rig knows, driven by an odometer whose noise it knows and whose errors of
/// scale it does not. Uniform where nothing else is said:
///   room            6 to 14 m by 60 to 100 % of that
///   way             two laps of a rectangle, 20 to 30 % of the shorter side from the walls; every second world the
///   same
///                   length in random legs within it
///   landmarks       8 to 30, anywhere, 0.6 m apart and 0.4 m off the way; fewer where there is no room left
///   drive           0.3 to 0.8 m/s, an image each 0.6 to 2 s
///   bearings        0.5 to 2 degrees (standard deviation), seen within 5 to 10 m, of which up to 30 % are missed, and
///                   up to 20 % of all are of nothing
///   odometry        1 to 5 cm a square root of metre, 2 to 6 degrees a full turn, 0.5 to 2.5 degrees a square root of
///                   metre; scales of distance and of turn wrong by 1 % each (normal)
struct RandomWorld {
  Scenario scenario;           ///< as it is, with what the odometer gets wrong
  double clutter_share = 0.0;  ///< of all bearings
  Rectangle room;
};
/// Same seed, same world.
RandomWorld random_world(std::uint64_t seed);

/// The drive through it. Its rig takes the odometer's scales for right. Bearings have names, to judge by.
Run run_through(const RandomWorld& world);

}  // namespace azimuth
