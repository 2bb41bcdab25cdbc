#pragma once
// Calibrates odometry and the mounting of the camera on the robot from a recorded drive.

#include <optional>
#include <string>

#include "tools/drive_fit/creep.hpp"
#include "tools/drive_fit/known_points.hpp"
#include "tools/drive_fit/odometry_noise.hpp"
#include "tools/drive_fit/spread.hpp"

namespace azimuth {

/// A calibrated number.
struct FoundNumber {
  double value = 0.0, sigma = 0.0;
  bool told = false;  ///< false if sigma is too large: the drive hardly adds to the prior
};

struct OdometryCalibration {
  FoundNumber turn, drift, lag;
  OdometryNoise noise;
  /// Creep measured at standstills. If the drive tells it, the noise floors of the rig in `solution` cover it.
  Creep creep;
  DriveSolution solution;  ///< fitted drive, whose rig contains all calibrated values
};
/// Calibrates odometry. `rig` is the starting point and may be uncalibrated.
OdometryCalibration calibrate_odometry(const Drive& drive, const Rig& rig, const HindsightSettings& settings);

struct HeadingCalibration {
  FoundNumber yaw;  ///< yaw of the camera: robot azimuth = camera azimuth + yaw
  /// Position of the camera on the robot [m], forwards and to the left. Either both are told or neither; if untold, the
  /// solution keeps the rig's position.
  FoundNumber ahead;
  FoundNumber left;
  bool mirrored = false;   ///< azimuths grow in the opposite direction to the rig's
  bool hand_told = false;  ///< the drive decides `mirrored` surely
  DriveSolution solution;
};
HeadingCalibration calibrate_heading(const Drive& drive, const Rig& rig, const HindsightSettings& settings);

/// Prior standard deviations of the odometry parameters and the camera's yaw for an uncalibrated rig.
FreeErrors free_heading();

/// Least share of bearings that must fit. With fewer, the fitted numbers mean nothing.
inline constexpr double kMostMustFit = 0.5;

/// ln of the likelihood ratio between two fits of a drive. The ratio is divided by the mean chi squared of the better
/// fit if that exceeds 1, since some rigs state too little noise and bearing errors are correlated.
double evidence(const DriveSolution& better, const DriveSolution& than);

/// A sentence that says why the drive cannot be fitted at all; empty if it can.
std::string why_cannot_tell(const Drive& drive, const Rig& rig);

}  // namespace azimuth
