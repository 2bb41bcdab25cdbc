#pragma once
#include <span>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/smoother/odometry_measurement.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// Motion between two instants by odometry, and its derivatives by the two numbers of a lag.
struct DriveMotion {
  Motion motion;
  ByLag by_lag = ByLag::Zero();
};

/// One motion for each of the ascending `stamps`, from the previous stamp; the first one starts at the first reading.
/// An instant that no reading covers counts as the nearest covered one. `large_turns_alone`: only large turns determine
/// the scale of turns, because the robot makes small ones to correct heading errors (mathematics VI.25). A lag is
/// always determined by large turns alone.
std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                                         std::span<const Stamp> stamps, bool large_turns_alone = false);

/// Motions of the camera, with the guess's mount and clock jump. The columns of `by_lag` are the derivatives by the two
/// numbers that guess.numbers selects.
std::vector<DriveMotion> motions_between(std::span<const OdometryReading> odometry, const RigGuess& guess,
                                         std::span<const Stamp> stamps);

/// Dead-reckoning poses of the robot at `stamps`, in the odometry frame.
std::vector<Pose2> odometry_at(std::span<const OdometryReading> odometry, const OdometryRig& rig,
                               std::span<const Stamp> stamps);
/// Dead-reckoning poses of the camera at `stamps`, with the heading of the robot.
std::vector<Pose2> camera_at(std::span<const OdometryReading> odometry, const RigGuess& guess,
                             std::span<const Stamp> stamps);

}  // namespace azimuth
