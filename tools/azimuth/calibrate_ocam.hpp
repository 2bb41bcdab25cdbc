#pragma once
// azimuth calibrate fisheye --ocam: the lens from a calibration that OCamCalib made.

#include <filesystem>

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

struct OcamOptions {
  std::filesystem::path calibration;  ///< its calib_results.txt
  std::filesystem::path rig;          ///< empty: all else is to be filled in
  CalibrationOutputs outputs;
};

void calibrate_by_ocam(const OcamOptions& options);

}  // namespace azimuth
