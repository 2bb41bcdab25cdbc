#pragma once
// Internal to tools/check: finds motions in raw odometry that no wheel can make.

#include <cstddef>
#include <span>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A leap is a step between two readings that is much longer than the robot's typical speed allows, exceeds the
/// acceleration that tyres can transmit, and is not continued by the steps before and after.
struct OdometryLeaps {
  std::size_t readings = 0;
  std::size_t leaps = 0;
  std::size_t undone = 0;     ///< leaps that an opposite leap cancels within some readings
  std::size_t to_origin = 0;  ///< leaps that end at the odometer's first pose or at zero
  double typical_m = 0.0;     ///< median length of a leap
  Stamp first{};              ///< stamp of the reading that ends the first leap

  bool are_two_senders() const;
  bool is_any() const { return leaps > 0; }
};

/// Finds leaps between readings of the same origin. A restart that the odometer reports itself (a new origin) is no
/// step.
OdometryLeaps odometry_leaps(std::span<const OdometryReading> odometry);

}  // namespace azimuth
