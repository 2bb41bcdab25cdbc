#include "sim/renderer/standard_cameras.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "slam/camera/camera_rig.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

namespace {

ImageRig common_image() {
  ImageRig image;
  image.width_px = 1024;
  image.height_px = 768;
  image.centre_px = {511.5, 383.5};
  image.azimuth_direction = -1;
  image.azimuth_offset_rad = -kPi / 2;  // The heading points up in the image
  return image;
}

CameraRig mirror() {
  CameraRig rig{.model = HyperbolicMirrorRig{.a_mm = 28.095, .b_mm = 23.4125, .focal_length_px = 1035.376},
                .image = common_image()};
  rig.image.viewpoint_height_m = 1.0;
  rig.image.mask_inner_px = 60.0;
  rig.image.mask_outer_px = 376.0;
  return rig;
}

/// Very nearly r = 2 * 119.2 px * theta: 1.57 rad lie 374 px from the centre.
CameraRig fisheye() {
  CameraRig rig{.model = PajdlaRig{.a_px = 11920.0, .b = 100.0, .c_px = 11920.0, .d = 100.0}, .image = common_image()};
  rig.image.viewpoint_height_m = 1.8;
  rig.image.theta_max_rad = 1.55;
  return rig;
}

}  // namespace

std::optional<CameraRig> standard_camera(std::string_view name) {
  if (name == "mirror") return mirror();
  if (name == "fisheye") return fisheye();
  return std::nullopt;
}

CameraRig scaled(CameraRig rig, double factor) {
  ImageRig& image = rig.image;
  for (std::optional<int>* const side : {&image.width_px, &image.height_px})
    if (*side) **side = std::max(1, static_cast<int>(std::lround(**side * factor)));
  // Pixel coordinates refer to pixel centres, so the image's corner is at -0.5.
  if (image.centre_px)
    for (double& coordinate : *image.centre_px) coordinate = (coordinate + 0.5) * factor - 0.5;
  for (std::optional<double>* const length : {&image.mask_inner_px, &image.mask_outer_px})
    if (*length) **length *= factor;
  for (const ModelParameter& parameter : parameters(rig.model))
    if (parameter.key.ends_with("_px")) *parameter.value *= factor;
  return rig;
}

std::string image_camera_toml(const CameraRig& rig) {
  const ImageRig& image = rig.image;
  const bool is_fisheye = looks_up(rig.model);
  std::string text =
      fmt::format("front_end = \"{}\"\n\n[camera]\nmodel = \"{}\"\n", is_fisheye ? "lamps" : "colour", name(rig.model));
  const auto add = [&text](std::string_view key, const std::optional<double>& value) {
    if (value) text += fmt::format("{} = {:#}\n", key, *value);  // With a decimal point, which TOML requires for floats
  };
  text += fmt::format("width_px = {}\nheight_px = {}\n", image.width_px.value_or(0), image.height_px.value_or(0));
  const PixelPoint centre = image.centre_px.value_or(PixelPoint{});
  text +=
      fmt::format("centre_px = [{:#}, {:#}]\nazimuth_direction = {}\n", centre[0], centre[1], image.azimuth_direction);
  add("beta", image.beta);
  add("azimuth_offset_rad", image.azimuth_offset_rad);
  add("yaw_offset_rad", rig.yaw_offset_rad);
  if (rig.roll_rad != 0.0) add("roll_rad", rig.roll_rad);
  if (rig.pitch_rad != 0.0) add("pitch_rad", rig.pitch_rad);
  add("viewpoint_height_m", image.viewpoint_height_m);
  add("mask_inner_px", image.mask_inner_px);
  add("mask_outer_px", image.mask_outer_px);
  ModelRig model = rig.model;
  for (const ModelParameter& parameter : parameters(model)) add(parameter.key, *parameter.value);
  add("theta_max_rad", image.theta_max_rad);
  return text;
}

}  // namespace azimuth
