#pragma once
#include <span>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/smoother/odometry_measurement.hpp"
#include "tools/drive_fit/rig_guess.hpp"

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

/// Likewise of the camera, as a guess has it: its mount, the jump of its clock, and in `by_lag` what the guess's
/// numbers stand for.
std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const RigGuess& guess,
                                         std::span<const Stamp> stamps);

/// Where odometry has the robot at these instants, in a frame of its own.
std::vector<Pose2> odometry_at(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                               std::span<const Stamp> stamps);
/// Likewise the camera of a guess, its heading that of the robot.
std::vector<Pose2> camera_at(std::span<const OdometryReading> odometry, const RigGuess& guess,
                             std::span<const Stamp> stamps);

}  // namespace azimuth
