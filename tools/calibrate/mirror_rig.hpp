#pragma once
#include <string>

#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"

namespace azimuth {

/// Properties of a mirror camera that images do not show.
struct MirrorModel {
  std::string model = "radial";  ///< "radial", "hyperbolic_mirror" or "parabolic_mirror"
  FrontEnd front_end = FrontEnd::sift;
  std::optional<double> mirror_a_mm, mirror_b_mm, focal_length_px, horizon_radius_px;
};

/// The rig of a robot whose mirror was found in images of the given format. All other values are defaults; the robot's
/// heading points up in the image.
Rig mirror_rig(const MirrorCircle& mirror, const FrameFormat& format, const MirrorModel& model);

/// The text of rig.toml, with comments that list what the user has to check before use. `images`: number of images
/// used. `why_front_end`: reason for the choice of front end; empty if the user chose it.
std::string mirror_rig_text(const Rig& rig, int images, const std::string& why_front_end = {});

/// Heading drift variance of an unknown robot: (1.8 degrees)^2 per metre. If the value is too small, the filter takes
/// heading drift for an error of the image centre and estimates both wrongly. If it is too large, the filter only
/// converges more slowly.
inline constexpr double kUnknownDrift_rad2_per_m = 1e-3;

/// Distance of the mask from the rim and from the inner disc, whose edges are blurred by about this much.
inline constexpr double kMaskMargin_px = 2.0;

/// Difference between the image centre in a rig and the centre of the mirror found in images.
struct CentreComparison {
  double off_px = 0.0;
  double worst_azimuth_rad = 0.0;  ///< largest bearing error at half of the rim's radius
  bool agrees = false;             ///< off_px is within kCentreTolerance_px plus 3 sigma of the centre found
};
inline constexpr double kCentreTolerance_px = 3.0;

CentreComparison compare_centre(const MirrorCircle& mirror, const ImageRig& rig);

/// One line for the user. `file` names the rig.
std::string text(const CentreComparison& comparison, const std::string& file);

}  // namespace azimuth
