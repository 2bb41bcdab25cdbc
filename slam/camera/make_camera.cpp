#include "slam/camera/make_camera.hpp"

#include <limits>

namespace azimuth {
namespace {

/// The radial profile of each model; models without elevations have none.
struct ProfileOf {
  double theta_max_rad;

  using Profile = std::optional<RadialProfile>;
  Profile operator()(const BearingsRig&) const { return std::nullopt; }
  Profile operator()(const RadialRig&) const { return std::nullopt; }
  Profile operator()(const HyperbolicMirrorRig& mirror) const {
    return HyperbolicMirror{mirror.a_mm, mirror.b_mm, mirror.focal_length_px};
  }
  Profile operator()(const ParabolicMirrorRig& mirror) const { return ParabolicMirror{mirror.horizon_radius_px}; }
  Profile operator()(const PajdlaRig& lens) const {
    return PajdlaFisheye{lens.a_px, lens.b, lens.c_px, lens.d, theta_max_rad};
  }
  Profile operator()(const EquidistantRig& lens) const {
    return EquidistantFisheye{lens.focal_length_px, theta_max_rad};
  }
  Profile operator()(const PolynomialRig& lens) const { return PolynomialFisheye{lens.a, theta_max_rad}; }
};

constexpr double kMountedByEye_rad = 0.02;  // One degree, for roll and for pitch

/// Integer values are pixel centres, so the middle of 4 pixels is at 1.5.
double middle(const std::optional<int>& pixels) { return pixels ? 0.5 * (*pixels - 1) : kNotSet; }

}  // namespace

ImageAxes axes_of(const ImageRig& image) {
  const PixelPoint middle_px{middle(image.width_px), middle(image.height_px) / image.beta};
  const PixelPoint centre = image.centre_px.value_or(middle_px);
  return {{centre[0], centre[1]}, image.beta, image.azimuth_direction, image.azimuth_offset_rad};
}

CameraTilt tilt_of(const CameraRig& rig) { return {rig.roll_rad, rig.pitch_rad}; }

double sigma_tilt_rad(const CameraRig& rig) {
  const bool knows_elevations =
      !std::holds_alternative<BearingsRig>(rig.model) && !std::holds_alternative<RadialRig>(rig.model);
  return knows_elevations ? rig.sigma_tilt_rad.value_or(kMountedByEye_rad) : 0.0;
}

MaskShape mask_of(const ImageRig& image) {
  MaskShape shape;
  shape.inner_px = image.mask_inner_px.value_or(0.0);
  shape.outer_px = image.mask_outer_px.value_or(std::numeric_limits<double>::infinity());
  for (const auto& polygon : image.mask_polygons_px) {
    std::vector<Pixel>& corners = shape.hidden.emplace_back();
    for (const PixelPoint& corner : polygon) corners.emplace_back(corner[0], corner[1]);
  }
  return shape;
}

bool is_size_of(const FrameFormat& format, const ImageRig& image) {
  return image.width_px.value_or(format.width_px) == format.width_px &&
         image.height_px.value_or(format.height_px) == format.height_px;
}

std::optional<CameraModel> camera_of(const CameraRig& rig, std::string& problem) {
  const std::optional<RadialProfile> profile =
      std::visit(ProfileOf{rig.image.theta_max_rad.value_or(kNotSet)}, rig.model);
  if (!profile) {
    problem = "camera model \"" + std::string(name(rig.model)) + "\" says nothing about elevations";
    return std::nullopt;
  }
  const ImageAxes axes = axes_of(rig.image);
  if (const auto wrong = CameraModel::problem(axes, *profile)) {
    problem = *wrong;
    return std::nullopt;
  }
  return CameraModel(axes, *profile, tilt_of(rig));
}

}  // namespace azimuth
