#pragma once
// azimuth calibrate RUN: all that one drive tells of the rig.

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

struct RunCalibrationOptions {
  ReplayOptions run;
  CalibrationOutputs outputs;
};

/// Begins from the run's rig, or from none: then from what its images or bearings are. Prints what was found and what
/// the drive cannot tell. Refuses drives that tell nothing.
void calibrate_by_run(const RunCalibrationOptions& options);

}  // namespace azimuth
