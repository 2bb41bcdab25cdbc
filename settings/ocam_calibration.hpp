#pragma once
// Reads calib_results.txt, the result of OCamCalib, the usual calibration tool for fisheyes.

#include <string>
#include <string_view>

#include "base/file_result.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {

struct OcamCalibration {
  CameraRig camera;
  double left_out_px = 0.0;  ///< largest distance by which the shear that is left out moves a pixel of the image
};

/// Reads the camera from the text, with the model "polynomial" and an axis that points straight up. The file has only
/// the intrinsic parameters, so the caller must set mounting, noise and masks. theta_max is the angle at the end of the
/// image, at most a right angle.
///
/// Comments begin with '#'. The numbers are, in this order: count and coefficients of the direct polynomial (at most
/// 5); count and coefficients of the inverse polynomial; row and column of the centre; affine c, d, e; height and
/// width. The inverse polynomial must be present but is not used, since the inverse is computed exactly. The affine c
/// stretches the rows and becomes beta. The affine d and e rotate the image about the centre and shear it. The rotation
/// only shifts the origin of the azimuths, which must be calibrated in any case. The shear is left out; a shear that
/// moves a pixel by more than one pixel is refused.
FileResult<OcamCalibration> read_ocam_calibration(std::string_view text, const std::string& file);

}  // namespace azimuth
