#pragma once
#include <string>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"

namespace azimuth {

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
