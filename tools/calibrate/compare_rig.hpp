#pragma once
#include <string>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/calibration/mirror_finder.hpp"

namespace azimuth {

/// How far a rig's centre is from the mirror's.
struct CentreComparison {
  double off_px = 0.0;
  double worst_azimuth_rad = 0.0;  ///< error of a bearing at half of the rim's radius
  bool agrees = false;             ///< within kCentreTolerance_px and what the images leave uncertain
};
inline constexpr double kCentreTolerance_px = 3.0;

CentreComparison compare_centre(const MirrorCircle& mirror, const ImageRig& rig);

/// In a line, with `file` for the rig.
std::string text(const CentreComparison& comparison, const std::string& file);

}  // namespace azimuth
