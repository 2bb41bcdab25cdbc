#pragma once
// calib_results.txt of OCamCalib, the usual calibration tool for fisheyes.

#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

struct OcamCalibration {
  CameraRig camera;
  double left_out_px = 0.0;  ///< the most by which what is not modelled moves a pixel of the image
};

/// The camera that the text describes, model "polynomial", as if it looked straight up: only the file's intrinsic part
/// is there, so mounting, noise and masks are still to be set. theta_max is where the image ends, at most a right
/// angle.
///
/// Comments begin with '#'. Of the numbers, in this order: count and coefficients of the direct polynomial (at most 5);
/// count and coefficients of the inverse one, which are only checked to be there, since the inverse is found exactly;
/// row and column of the centre; affine c, d, e; height and width. Of the affine part c stretches rows and becomes
/// beta. What d and e turn about the centre is taken into the azimuths, whose origin has to be found in any case; what
/// they shear beside that is left out, and refused where it moves a pixel by more than one.
FileResult<OcamCalibration> read_ocam_calibration(std::string_view text, const std::string& file);

}  // namespace azimuth
