#include "sim/renderer/rig_camera.hpp"

#include <limits>

namespace azimuth {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();  // makes every model say what is wrong with it

std::optional<RadialProfile> profile_of(const CameraRig& rig) {
  const ImageRig& image = rig.image;
  if (rig.model == "hyperbolic_mirror") {
    return HyperbolicMirror{image.mirror_a_mm.value_or(kMissing), image.mirror_b_mm.value_or(kMissing),
                            image.focal_length_px.value_or(kMissing)};
  }
  if (rig.model == "pajdla") {
    return PajdlaFisheye{image.a_px.value_or(kMissing), image.b.value_or(kMissing), image.c_px.value_or(kMissing),
                         image.d.value_or(kMissing), image.theta_max_rad.value_or(kMissing)};
  }
  return std::nullopt;
}

ImageAxes axes_of(const ImageRig& image) {
  const PixelPoint centre = image.centre_px.value_or(PixelPoint{kMissing, kMissing});
  return {{centre[0], centre[1]}, image.beta, image.azimuth_direction, image.azimuth_offset_rad};
}

}  // namespace

std::optional<RenderCamera> camera_of(const CameraRig& rig, std::string& problem) {
  const std::optional<RadialProfile> profile = profile_of(rig);
  if (!profile) {
    problem = "camera model \"" + rig.model + "\" makes no images";
    return std::nullopt;
  }
  const ImageAxes axes = axes_of(rig.image);
  problem = CameraModel::problem(axes, *profile);
  if (!problem.empty()) return std::nullopt;
  RenderCamera camera{.model = CameraModel(axes, *profile), .mask = {}, .T_body_camera = {}, .sensor = {}};
  camera.width_px = rig.image.width_px.value_or(0);
  camera.height_px = rig.image.height_px.value_or(0);
  camera.mask.inner_px = rig.image.mask_inner_px.value_or(0.0);
  camera.mask.outer_px = rig.image.mask_outer_px.value_or(std::numeric_limits<double>::infinity());
  camera.height_m = rig.image.viewpoint_height_m.value_or(0.0);
  camera.T_body_camera.heading_rad = rig.yaw_offset_rad;
  return camera;
}

}  // namespace azimuth
