#include "slam/camera/make_camera.hpp"

#include <limits>

namespace azimuth {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();  // makes every model say what is wrong with it

std::optional<RadialProfile> profile_of(const CameraRig& rig) {
  const ImageRig& image = rig.image;
  const double focal_length_px = image.focal_length_px.value_or(kMissing);
  const double theta_max_rad = image.theta_max_rad.value_or(kMissing);
  if (rig.model == "hyperbolic_mirror") {
    return HyperbolicMirror{image.mirror_a_mm.value_or(kMissing), image.mirror_b_mm.value_or(kMissing),
                            focal_length_px};
  }
  if (rig.model == "parabolic_mirror") return ParabolicMirror{image.horizon_radius_px.value_or(kMissing)};
  if (rig.model == "equidistant") return EquidistantFisheye{focal_length_px, theta_max_rad};
  if (rig.model == "pajdla") {
    return PajdlaFisheye{image.a_px.value_or(kMissing), image.b.value_or(kMissing), image.c_px.value_or(kMissing),
                         image.d.value_or(kMissing), theta_max_rad};
  }
  if (rig.model == "polynomial") {
    return PolynomialFisheye{{image.polynomial_a0.value_or(kMissing), image.polynomial_a1.value_or(0.0),
                              image.polynomial_a2.value_or(kMissing), image.polynomial_a3.value_or(kMissing),
                              image.polynomial_a4.value_or(kMissing)},
                             theta_max_rad};
  }
  return std::nullopt;
}

/// Whole numbers are the centres of pixels, so the middle of 4 of them is at 1.5.
double middle(const std::optional<int>& pixels) { return pixels ? 0.5 * (*pixels - 1) : kMissing; }

}  // namespace

ImageAxes axes_of(const ImageRig& image) {
  const PixelPoint middle_px{middle(image.width_px), middle(image.height_px) / image.beta};
  const PixelPoint centre = image.centre_px.value_or(middle_px);
  return {{centre[0], centre[1]}, image.beta, image.azimuth_direction, image.azimuth_offset_rad};
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
  const std::optional<RadialProfile> profile = profile_of(rig);
  if (!profile) {
    problem = "camera model \"" + rig.model + "\" says nothing about elevations";
    return std::nullopt;
  }
  const ImageAxes axes = axes_of(rig.image);
  problem = CameraModel::problem(axes, *profile);
  if (!problem.empty()) return std::nullopt;
  return CameraModel(axes, *profile);
}

bool looks_up(const CameraRig& rig) {
  const std::optional<RadialProfile> profile = profile_of(rig);
  return profile && std::visit([](const auto& model) { return model.kLooksUp; }, *profile);
}

}  // namespace azimuth
