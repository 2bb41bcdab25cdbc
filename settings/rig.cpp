#include "settings/rig.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

#include "settings/file_text.hpp"
#include "settings/reader.hpp"

namespace azimuth {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMaxPixels = 1e5;

Section top_section(Rig& rig) {
  return {"",
          "What is fixed on the robot.",
          {choice<FrontEnd>("front_end", rig.front_end,
                            {{"bearings", FrontEnd::bearings},
                             {"colour", FrontEnd::colour},
                             {"sift", FrontEnd::sift},
                             {"lamps", FrontEnd::lamps}},
                            "How directions reach the estimator.")}};
}

std::vector<Key> image_keys(ImageRig& image) {
  return {
      {"width_px", &image.width_px, "Width of the image.", from_to(1, kMaxPixels)},
      {"height_px", &image.height_px, "Height of the image.", from_to(1, kMaxPixels)},
      {"centre_px", &image.centre_px, "Where the optical axis meets the image, [u, v].",
       from_to(-kMaxPixels, kMaxPixels)},
      {"beta", &image.beta, "Height of a pixel over its width.", from_to(0.1, 10)},
      {"azimuth_direction", &image.azimuth_direction,
       "1 or -1: azimuth = direction * atan2(v/beta - v0, u - u0) + azimuth_offset_rad.", from_to(-1, 1)},
      {"azimuth_offset_rad", &image.azimuth_offset_rad, "Azimuth of the image's u axis.", from_to(-2 * kPi, 2 * kPi)},
      {"viewpoint_height_m", &image.viewpoint_height_m, "Height of the viewpoint above the floor.", above_to(0, 100)},
      {"sigma_px", &image.sigma_px, "Standard deviation of a detection, along u and along v.", above_to(0, 1000)},
      {"detection_probability", &image.detection_probability, "Chance that something in view is detected.",
       above_to(0, 1)},
      {"mask_inner_px", &image.mask_inner_px, "Radius about the centre hidden by robot and mounting.",
       from_to(0, kMaxPixels)},
      {"mask_outer_px", &image.mask_outer_px, "Radius of the mirror's rim.", above_to(0, kMaxPixels)},
      {"mask_polygons_px", &image.mask_polygons_px,
       "Hidden as well (struts, cables): polygons of three corners or more, [[[u, v], [u, v], [u, v]], ...].",
       from_to(-kMaxPixels, kMaxPixels)},
      {"a_px", &image.a_px, "pajdla: a of r = a tan(theta/b) + c sin(theta/d).", from_to(-1e9, 1e9)},
      {"b", &image.b, "pajdla: b.", above_to(0, 1e6)},
      {"c_px", &image.c_px, "pajdla: c.", from_to(-1e9, 1e9)},
      {"d", &image.d, "pajdla: d.", above_to(0, 1e6)},
      {"theta_max_rad", &image.theta_max_rad, "Largest angle from the optical axis the model holds for.",
       above_to(0, kPi)},
      {"mirror_a_mm", &image.mirror_a_mm, "hyperbolic_mirror: a of z^2/a^2 - r^2/b^2 = 1.", above_to(0, 1e4)},
      {"mirror_b_mm", &image.mirror_b_mm, "hyperbolic_mirror: b.", above_to(0, 1e4)},
      {"focal_length_px", &image.focal_length_px,
       "hyperbolic_mirror: focal length of its camera; equidistant: pixels per radian.", above_to(0, kMaxPixels)},
      {"horizon_radius_px", &image.horizon_radius_px,
       "parabolic_mirror: h of r = h tan(pi/4 + elevation/2), the horizon's radius.", above_to(0, kMaxPixels)},
      {"polynomial_a0", &image.polynomial_a0,
       "polynomial (OCamCalib): the angle from the axis is atan2(r, -(a0 + a1 r + ... + a4 r^4)), r in pixels.",
       from_to(-kMaxPixels, -1)},
      {"polynomial_a1", &image.polynomial_a1, "polynomial: a1, usually 0.", from_to(-1e3, 1e3)},
      {"polynomial_a2", &image.polynomial_a2, "polynomial: a2.", from_to(-1e3, 1e3)},
      {"polynomial_a3", &image.polynomial_a3, "polynomial: a3.", from_to(-1e3, 1e3)},
      {"polynomial_a4", &image.polynomial_a4, "polynomial: a4.", from_to(-1e3, 1e3)},
  };
}

Section camera_section(CameraRig& camera) {
  Section section{
      "camera",
      "The camera's model, mounting and noise.",
      {
          choice<std::string>(
              "model", camera.model,
              {{"bearings", "bearings"},
               {"radial", "radial"},
               {"hyperbolic_mirror", "hyperbolic_mirror"},
               {"parabolic_mirror", "parabolic_mirror"},
               {"pajdla", "pajdla"},
               {"equidistant", "equidistant"},
               {"polynomial", "polynomial"}},
              "bearings: directions come ready made; radial: only azimuths are known; mirrors; pajdla, equidistant and "
              "polynomial: fisheyes."),
          {"sigma_bearing_rad", &camera.sigma_bearing_rad, "Standard deviation of one azimuth.", above_to(0, kPi)},
          {"identities", &camera.identities, "Bearings carry the identity of what was seen."},
          {"field_of_view_rad", &camera.field_of_view_rad, "Full horizontal angle of view; 2 pi: all round.",
           above_to(0, 2 * kPi)},
          {"yaw_offset_rad", &camera.yaw_offset_rad,
           "Camera's zero azimuth from the robot's heading, counter-clockwise.", from_to(-kPi, kPi)},
      }};
  for (Key& key : image_keys(camera.image)) section.keys.push_back(std::move(key));
  return section;
}

Section odometry_section(OdometryRig& odometry) {
  return {
      "odometry",
      "Noise and calibration of the wheel odometry.",
      {
          choice<std::string>("kind", odometry.kind, {{"wheel_pose", "wheel_pose"}},
                              "wheel_pose: cumulative poses of the odometer."),
          {"lambda_distance_m", &odometry.lambda_distance_m, "Variance of the distance per metre driven [m^2/m].",
           from_to(0, 10)},
          {"lambda_rotation_rad", &odometry.lambda_rotation_rad, "Variance of a turn per radian turned [rad^2/rad].",
           from_to(0, 10)},
          {"lambda_drift_rad2_per_m", &odometry.lambda_drift_rad2_per_m, "Variance of the heading per metre driven.",
           from_to(0, 10)},
          {"sigma_lateral_m_per_sqrt_m", &odometry.sigma_lateral_m_per_sqrt_m,
           "Sideways slip: standard deviation after one metre.", from_to(0, 10)},
          {"floor_distance_m", &odometry.floor_distance_m,
           "Standard deviation added to the distance in each step that moved.", from_to(0, 10)},
          {"floor_rotation_rad", &odometry.floor_rotation_rad,
           "Standard deviation added to the heading in each step that moved.", from_to(0, kPi)},
          {"scale_distance", &odometry.scale_distance, "True distance over the reported one.", from_to(0.1, 10)},
          {"scale_turn", &odometry.scale_turn, "True turn over the reported one.", from_to(0.1, 10)},
          {"drift_rad_per_m", &odometry.drift_rad_per_m, "Heading gained for each metre driven.", from_to(-10, 10)},
          {"sigma_scale_distance", &odometry.sigma_scale_distance,
           "Standard deviation of scale_distance, as a share of it: map and path may be too large by this, which no "
           "bearing tells. 0.01 is a robot as it comes; 0.003 one calibrated over a measured drive of tens of metres.",
           from_to(0, 0.5)},
          {"sigma_scale_turn", &odometry.sigma_scale_turn, "Standard deviation of scale_turn, as a share of it.",
           from_to(0, 0.5)},
          {"lag_s", &odometry.lag_s, "The pose reported for time t is the robot's at t + lag.", from_to(-10, 10)},
      }};
}

/// Parameters without which an image model has no meaning.
std::vector<std::string_view> needed_by(const std::string& model) {
  if (model == "radial") return {"centre_px"};
  if (model == "parabolic_mirror") return {"centre_px", "horizon_radius_px"};
  if (model == "equidistant") return {"centre_px", "focal_length_px", "theta_max_rad"};
  if (model == "pajdla") return {"centre_px", "a_px", "b", "c_px", "d", "theta_max_rad"};
  if (model == "polynomial")
    return {"centre_px", "polynomial_a0", "polynomial_a2", "polynomial_a3", "polynomial_a4", "theta_max_rad"};
  if (model == "hyperbolic_mirror") return {"centre_px", "mirror_a_mm", "mirror_b_mm", "focal_length_px"};
  return {};
}

void check_model(const Rig& rig, Section& camera, const std::string& file, FileErrors& violations) {
  for (const std::string_view name : needed_by(rig.camera.model)) {
    if (camera.find(name)->given) continue;
    violations.push_back(
        {file, 0, fmt::format("camera model \"{}\" needs the key '{}' in [camera]", rig.camera.model, name)});
  }
  const ImageRig& image = rig.camera.image;
  if (image.azimuth_direction == 0) {
    violations.push_back({file, 0, "'camera.azimuth_direction' is 0, must be 1 or -1"});
  }
  if (image.mask_inner_px && image.mask_outer_px && *image.mask_inner_px >= *image.mask_outer_px) {
    violations.push_back({file, 0, "'camera.mask_inner_px' must be smaller than 'camera.mask_outer_px'"});
  }
}

}  // namespace

std::vector<Section> rig_sections(Rig& rig) {
  return {top_section(rig), camera_section(rig.camera), odometry_section(rig.odometry)};
}

FileResult<Rig> read_rig(std::string_view text, const std::string& file) {
  Rig rig;
  std::vector<Section> sections = rig_sections(rig);
  const std::vector<Section*> tables = pointers(sections);
  FileErrors violations = read_toml(text, file, tables);
  check_model(rig, *std::ranges::find(sections, "camera", &Section::name), file, violations);
  if (!violations.empty()) return failure(std::move(violations));
  return rig;
}

FileResult<Rig> read_rig_file(const std::filesystem::path& file) {
  return file_text(file).and_then([&](const std::string& text) { return read_rig(text, file.string()); });
}

std::string rig_text(const Rig& rig) {
  Rig copy = rig;
  std::string text;
  for (const Section& section : rig_sections(copy)) {
    if (!section.name.empty()) text += fmt::format("\n[{}]\n", section.name);
    for (const Key& key : section.keys) {
      if (const std::string value = key.value_text(); !value.empty())
        text += fmt::format("{} = {}  # {}\n", key.name, value, key.help);
    }
  }
  return text;
}

}  // namespace azimuth
