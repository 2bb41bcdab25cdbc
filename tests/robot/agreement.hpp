#pragma once
#include <cstddef>
#include <span>

#include "tests/robot/driven_robot.hpp"

namespace azimuth::test {

/// Difference between the driver's motion from `first` to `later` and that of the wheels. Both must have the same
/// origin.
Pose2 error_since(const Sighting& first, const Sighting& later);

/// Errors of the driver's odometry relative to the wheels. Each origin is compared from its first reading on.
struct Agreement {
  std::size_t readings = 0, origins = 0;
  double worst_m = 0.0, worst_rad = 0.0;
  /// Beyond the error that the coarse heading of the origin's first SIP explains at that distance.
  double worst_excess_m = 0.0;
};
Agreement agreement(std::span<const Sighting> sightings);

/// Resolution of a SIP: x and y in units of 1 mm, heading in 4096 steps per turn.
inline constexpr double kUnit_m = 0.001, kHeadingUnit_rad = 6.283185307179586 / 4096;

/// Fails if the error of the odometry exceeds what the SIP's resolution explains. Wheel ticks are finer, but their
/// direction is the coarse heading of the SIP, which causes a random walk; `walk_m` is its largest accepted error.
void expect_agreement(std::span<const Sighting> sightings, double walk_m = 0.0);

}  // namespace azimuth::test
