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

/// What a drive through a scenario produced. Lengths are rounded to 1e-6 m and angles to 1e-6 rad, which hides the last
/// bits in which mathematical libraries differ and keeps run folders small.
struct World {
  std::vector<OdometryReading> odometry;  ///< first reading at the origin of the odometer; the last one ends the drive
  std::vector<BearingSet> bearings;       ///< none later than the last odometry reading
  std::vector<TruePose> truth;
};

/// Same scenario, same world. Stamps begin at 0, or at minus the odometer's lag.
World simulate(const Scenario& scenario);

}  // namespace azimuth
