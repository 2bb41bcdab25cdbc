#pragma once
// What a drive says of its odometry, and of how the camera stands on the robot.

#include <optional>
#include <string>

#include "tools/drive_fit/creep.hpp"
#include "tools/drive_fit/known_points.hpp"
#include "tools/drive_fit/odometry_noise.hpp"
#include "tools/drive_fit/spread.hpp"

namespace azimuth {

/// A number that was looked for.
struct FoundNumber {
  double value = 0.0, sigma = 0.0;
  bool told = false;  ///< else the drive says no more than what is true of any robot
};

struct OdometryCalibration {
  FoundNumber turn, drift, lag;
  OdometryNoise noise;
  Creep creep;             ///< where the drive has standstills; the rig's floors cover it where it is told
  DriveSolution solution;  ///< with all of that in its rig
};
/// Begins from `rig`, which may be one that nobody has calibrated.
OdometryCalibration calibrate_odometry(const Drive& drive, const Rig& rig, const HindsightSettings& settings);

struct HeadingCalibration {
  FoundNumber yaw;  ///< of the camera: robot azimuth = camera azimuth + yaw
  /// Of the camera's position [m], both or neither: untold, the solution has it where the rig says.
  FoundNumber ahead;
  FoundNumber left;
  bool mirrored = false;  ///< azimuths grow the other way than the rig says
  bool hand_told = false;
  DriveSolution solution;
};
HeadingCalibration calibrate_heading(const Drive& drive, const Rig& rig, const HindsightSettings& settings);

/// What may be otherwise than a rig says that nobody has calibrated: its odometry and the camera's heading, standard
/// deviations.
FreeErrors free_heading();

/// Of the bearings of a drive whose rig is right: with fewer that fit, no number of the fit means anything.
inline constexpr double kMostMustFit = 0.5;

/// By how much a fit is more likely than another, as ln of the ratio, made smaller by what both leave unexplained: rigs
/// say too little noise now and then, and errors of bearings come in groups.
double evidence(const DriveSolution& better, const DriveSolution& than);

/// Why a drive cannot be fitted at all, in a sentence; empty: it can.
std::string why_cannot_tell(const Drive& drive, const Rig& rig);

}  // namespace azimuth
