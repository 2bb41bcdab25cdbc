#include "tools/calibrate/mirror_rig.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"

namespace azimuth {
namespace {

/// Rounds to hundredths of a pixel, which is finer than the accuracy of the images.
double rounded(double value_px) { return std::round(100.0 * value_px) / 100.0; }

/// Parameters that the user did not give become kNotSet.
ModelRig model_of(const MirrorModel& model) {
  const auto value = [](const std::optional<double>& given) { return given.value_or(kNotSet); };
  if (model.model == HyperbolicMirrorRig::kName)
    return HyperbolicMirrorRig{value(model.mirror_a_mm), value(model.mirror_b_mm), value(model.focal_length_px)};
  if (model.model == ParabolicMirrorRig::kName) return ParabolicMirrorRig{value(model.horizon_radius_px)};
  return RadialRig{};
}

}  // namespace

Rig mirror_rig(const MirrorCircle& mirror, const FrameFormat& format, const MirrorModel& model) {
  Rig rig;
  rig.front_end = model.front_end;
  rig.odometry.lambda_drift_rad2_per_m = kUnknownDrift_rad2_per_m;
  rig.camera.model = model_of(model);
  ImageRig& image = rig.camera.image;
  image.width_px = format.width_px;
  image.height_px = format.height_px;
  image.centre_px = {rounded(mirror.rim.centre_px.x()), rounded(mirror.rim.centre_px.y())};
  image.azimuth_direction = -1;
  image.azimuth_offset_rad = -std::numbers::pi / 2.0;
  image.mask_outer_px = rounded(mirror.rim.radius_px - kMaskMargin_px);
  if (mirror.inner) image.mask_inner_px = rounded(mirror.inner->radius_px + kMaskMargin_px);
  return rig;
}

std::string mirror_rig_text(const Rig& rig, int images, const std::string& why_front_end) {
  std::string text = fmt::format("# Made by azimuth calibrate mirror from {} image{}. Check before use:\n", images,
                                 images == 1 ? "" : "s");
  text +=
      "# - azimuth_direction, azimuth_offset_rad: images do not say where the robot's heading is. Here it is up in "
      "the\n"
      "#   image, and what turns counter-clockwise about the robot turns clockwise in the image, as mirrors have it.\n";
  text += "# - front_end: " + (why_front_end.empty() ? "as asked for" : why_front_end) + ".\n";
  text += "# - [odometry]: noise of a robot whose heading drifts much; azimuth calibrate odometry measures yours.\n";
  if (!rig.camera.image.mask_inner_px) {
    text += "# - mask_inner_px: no disc was found that hides robot and camera; give its radius if there is one.\n";
  }
  text += "# - mask_polygons_px: struts and cables, which no circle hides.\n\n";
  return text + rig_text(rig);
}

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
