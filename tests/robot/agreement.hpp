#pragma once
#include <cstddef>
#include <span>

#include "tests/robot/driven_robot.hpp"

namespace azimuth::test {

/// What the driver's motion from `first` to `later`, of the same origin, is off that of the wheels.
Pose2 error_since(const Sighting& first, const Sighting& later);

/// How far the driver's odometry came from that of the wheels. Each origin counts from its first reading on.
struct Agreement {
  std::size_t readings = 0, origins = 0;
  double worst_m = 0.0, worst_rad = 0.0;
  double worst_excess_m = 0.0;  ///< over what the coarse heading of the origin's first SIP explains at that distance
};
Agreement agreement(std::span<const Sighting> sightings);

/// Resolution of a SIP: x and y in whole units of one millimetre, heading in 4096 steps a turn.
inline constexpr double kUnit_m = 0.001, kHeadingUnit_rad = 6.283185307179586 / 4096;

/// Fails where the odometry is farther off than the SIP's resolution explains. Wheel ticks are finer, but go in the
/// direction of the SIP's coarse heading, which is a random walk: `walk_m` is what it may come to.
void expect_agreement(std::span<const Sighting> sightings, double walk_m = 0.0);

}  // namespace azimuth::test
