#pragma once
// azimuth calibrate RUN: all that one drive tells of the rig.

#include <array>
#include <string>
#include <vector>

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

/// What a drive may tell of a rig: which way azimuths grow and from where, where the camera stands and how it leans,
/// the odometer's scale of turns, drift, lag and noise, and how noisy bearings are.
inline constexpr std::array kRigParts{"heading", "position", "tilt", "turn", "drift", "lag", "noise", "bearings"};

struct RunCalibrationOptions {
  ReplayOptions run;
  CalibrationOutputs outputs;
  std::vector<std::string> only;  ///< of kRigParts; empty: all of them
};

/// Begins from the run's rig, or from none: then from what its images or bearings are. Prints what was found and what
/// the drive cannot tell. All is fitted together, whatever part of it is asked for: the rest stays in the rig as it
/// was. Refuses drives that tell nothing.
void calibrate_by_run(const RunCalibrationOptions& options);

}  // namespace azimuth
