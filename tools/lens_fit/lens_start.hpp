#pragma once
// Prepares the calibration of a fisheye: initial lens, priors and motions before any image is processed.

#include <optional>
#include <string>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/lens_fit/lens_fit.hpp"

namespace azimuth {

/// Values from the command line that the rig does not contain.
struct FisheyeRequest {
  std::optional<double> lamp_height_m;  ///< height of the lamps above the floor; nothing if unknown
  double sigma_lamp_height_m = 0.02;    ///< standard deviation of lamp_height_m
  double sigma_one_lamp_m = 0.02;       ///< standard deviation of a single lamp about lamp_height_m
  /// Full angle of the lens. If given, the fit starts from r = f theta instead of the rig's model.
  std::optional<double> field_of_view_rad;
};

struct FisheyeStart {
  Rig rig;  ///< used for the first detection of lamps
  Lens lens;
  LensPriors priors;
  std::vector<Motion> motions;  ///< one per image, from the previous image
};

/// If the run or the rig is unsuitable, the result is empty and `problem` has one sentence with the reason.
std::optional<FisheyeStart> fisheye_start(const Run& run, const Rig& rig, const FisheyeRequest& request,
                                          std::string& problem);

}  // namespace azimuth
