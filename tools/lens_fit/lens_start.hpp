#pragma once
// Where the calibration of a fisheye begins: what is known before any image is looked at.

#include <optional>
#include <string>

#include "drivers/storage/run.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/lens_fit/lens_fit.hpp"

namespace azimuth {

/// What the rig does not say.
struct FisheyeRequest {
  std::optional<double> lamp_height_m;  ///< of the lamps above the floor; nothing: nobody measured it
  double sigma_lamp_height_m = 0.02;    ///< how well
  double sigma_one_lamp_m = 0.02;       ///< of one lamp about that
  std::optional<double>
      field_of_view_rad;  ///< full angle of the lens: begin from r = f theta, not from the rig's model
};

struct FisheyeStart {
  Rig rig;  ///< that lamps are looked for with at first
  Lens lens;
  LensPriors priors;
  std::vector<Motion> motions;  ///< one an image, from the image before
};

/// Nothing, and in `problem` one sentence that says why, when the run or the rig is not for this.
std::optional<FisheyeStart> fisheye_start(const Run& run, const Rig& rig, const FisheyeRequest& request,
                                          std::string& problem);

}  // namespace azimuth
