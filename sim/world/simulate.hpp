#pragma once
#include <vector>

#include "sim/world/scenario.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

struct TruePose {
  Stamp stamp{};
  Pose2 T_world_body;
  friend bool operator==(const TruePose&, const TruePose&) = default;
};

/// The result of a drive through a scenario. Lengths are rounded to 1e-6 m and angles to 1e-6 rad, which removes the
/// last bits in which mathematical libraries differ and keeps run folders small.
struct World {
  /// The first reading is at the odometer's origin; the last one ends the drive.
  std::vector<OdometryReading> odometry;
  std::vector<BearingSet> bearings;  ///< No set is later than the last odometry reading
  std::vector<TruePose> truth;
};

/// The same scenario gives the same world. Stamps begin at 0, or at minus the odometer's lag.
World simulate(const Scenario& scenario);

}  // namespace azimuth
