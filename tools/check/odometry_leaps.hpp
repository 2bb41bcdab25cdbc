#pragma once
// Internal to tools/check: ways that no wheel goes, in odometry as it came.

#include <cstddef>
#include <span>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A leap is a step much larger than the robot's pace, farther than tyres could push it in that time, and that the
/// steps before and after do not go on with.
struct OdometryLeaps {
  std::size_t readings = 0;
  std::size_t leaps = 0;
  std::size_t undone = 0;     ///< of these: the opposite one follows within some readings
  std::size_t to_origin = 0;  ///< of these: to where the odometer began, or to zero
  double typical_m = 0.0;     ///< median length
  Stamp first{};              ///< after the first one

  bool are_two_senders() const;
  bool is_any() const { return leaps > 0; }
};

/// Of readings of one origin; where the odometer says itself that it began anew there is no step.
OdometryLeaps odometry_leaps(std::span<const OdometryReading> odometry);

}  // namespace azimuth
