#pragma once
// azimuth calibrate fisheye --ocam: takes the lens from a calibration by OCamCalib.

#include <filesystem>

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

struct OcamOptions {
  std::filesystem::path calibration;  ///< calib_results.txt of OCamCalib
  std::filesystem::path rig;          ///< empty: the user fills in everything but the lens
  CalibrationOutputs outputs;
};

void calibrate_by_ocam(const OcamOptions& options);

}  // namespace azimuth
