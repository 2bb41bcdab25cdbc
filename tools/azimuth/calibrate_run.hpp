#pragma once
// azimuth calibrate RUN: calibrates everything that one drive tells of the rig.

#include <array>
#include <string>
#include <vector>

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

/// The parts of a rig that a drive can tell: direction and origin of the azimuths, the camera's position and tilt, the
/// odometer's scale of turns, drift, lag and noise, and the noise of the bearings.
inline constexpr std::array kRigParts{"heading", "position", "tilt", "turn", "drift", "lag", "noise", "bearings"};

struct RunCalibrationOptions {
  ReplayOptions run;
  CalibrationOutputs outputs;
  std::vector<std::string> only;  ///< parts from kRigParts; empty: all parts
};

/// Calibrates the run's rig. A run without a rig begins from its images, of a mirror or of
/// lamps above a fisheye, or from its bearings. Below lamps the lens and the camera's heading are all that is found.
/// Prints the values that were found and the parts that the drive cannot tell. All parts are always fitted together,
/// but only the requested parts change in the rig. Writes the outputs that are asked for. Refuses drives that tell
/// nothing.
void calibrate_by_run(const RunCalibrationOptions& options);

}  // namespace azimuth
