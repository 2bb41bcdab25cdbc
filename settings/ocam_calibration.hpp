#pragma once
// calib_results.txt of OCamCalib, the usual calibration tool for fisheyes.

#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

/// The camera that the text describes, model "polynomial", as if it looked straight up: only the file's intrinsic part
/// is there, so mounting, noise and masks are still to be set. theta_max is where the image ends, at most a right
/// angle.
///
/// Comments begin with '#'. Of the numbers, in this order: count and coefficients of the direct polynomial (at most 5);
/// count and coefficients of the inverse one, which are only checked to be there, since the inverse is found exactly;
/// row and column of the centre; affine c, d, e; height and width. The affine part may stretch rows (c, which becomes
/// beta) but not shear: d and e within 1e-3 of 0 are taken as 0, which moves no pixel of an image by more than half
/// of one, and others are refused.
FileResult<CameraRig> read_ocam_calibration(std::string_view text, const std::string& file);

}  // namespace azimuth
