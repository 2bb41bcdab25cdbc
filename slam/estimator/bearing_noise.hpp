#pragma once
// The noise of one bearing. Thread contract: reentrant.

#include <cmath>

#include "slam/camera/camera_rig.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The standard deviation that the bearing carries, or the rig's if it carries none.
inline double sigma_rad(const Bearing& bearing, const CameraRig& rig) {
  return std::isnan(bearing.sigma_rad) ? rig.sigma_bearing_rad : bearing.sigma_rad;
}

}  // namespace azimuth
