#include "tools/calibrate/compare_rig.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "slam/camera/make_camera.hpp"

namespace azimuth {

CentreComparison compare_centre(const MirrorCircle& mirror, const ImageRig& rig) {
  const ImageAxes axes = axes_of(rig);
  const Pixel in_rig{axes.centre_px.x(), axes.beta * axes.centre_px.y()};
  CentreComparison comparison;
  comparison.off_px = (mirror.rim.centre_px - in_rig).norm();
  // A centre error d turns the bearing of a pixel at radius r, perpendicular to the error, by asin(d / r).
  comparison.worst_azimuth_rad = std::asin(std::min(1.0, comparison.off_px / (0.5 * mirror.rim.radius_px)));
  comparison.agrees = comparison.off_px <= kCentreTolerance_px + 3.0 * mirror.sigma_centre_px;
  return comparison;
}

std::string text(const CentreComparison& comparison, const std::string& file) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  return fmt::format(
      "{}: its centre is {:.1f} px off, which turns bearings at half the mirror's radius by up to {:.1f} deg: {}", file,
      comparison.off_px, comparison.worst_azimuth_rad * kDegrees,
      comparison.agrees ? "as good as the images can say" : "calibrate anew");
}

}  // namespace azimuth
