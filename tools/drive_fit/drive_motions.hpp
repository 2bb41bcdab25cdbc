#pragma once
#include <span>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/smoother/odometry_measurement.hpp"

namespace azimuth {

/// What odometry says of the way between two instants, and what a lag would make of it.
struct DriveMotion {
  Motion motion;
  ByLag by_lag = ByLag::Zero();
};

/// One for each of `stamps`, which ascend: from the one before; of the first one, from the first reading. Instants that
/// no reading covers count as the nearest one covered. `large_turns_alone`: the scale of turns is told by these only,
/// which nobody made to answer an error (SPEC VI.25); of a lag that is always so.
std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                                         std::span<const Stamp> stamps, bool large_turns_alone = false);

/// Where odometry has the robot at these instants, in a frame of its own.
std::vector<Pose2> odometry_at(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                               std::span<const Stamp> stamps);

}  // namespace azimuth
