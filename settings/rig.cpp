#include "settings/rig.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "settings/file_text.hpp"
#include "settings/reader.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kMaxModelPixels = 1e5;

/// The member that the key `name` fills.
std::optional<double>& member(std::vector<Key>& keys, std::string_view name) {
  const auto key = std::ranges::find(keys, name, &Key::name);
  assert(key != keys.end());
  return *std::get<std::optional<double>*>(key->target);
}

constexpr double kMaxPixels = 1e5;
constexpr double kMostTilt_rad = 0.8;  // a camera with a tilt larger than this does not look up
constexpr double kMaxMount_m = 3.0;    // a robot is a few metres long; a value larger than this is in millimetres

Section top_section(Rig& rig) {
  return {"",
          "The fixed properties of the robot.",
          {choice<FrontEnd>("front_end", rig.front_end,
                            {{"bearings", FrontEnd::bearings},
                             {"colour", FrontEnd::colour},
                             {"sift", FrontEnd::sift},
                             {"lamps", FrontEnd::lamps}},
                            "Source of the bearings. bearings: ready made; colour, sift and lamps: from images, by "
                            "coloured landmarks, image features or lamps.")}};
}

std::vector<Key> image_keys(ImageRig& image) {
  return {
      {"width_px", &image.width_px, "Width of the image.", from_to(1, kMaxPixels)},
      {"height_px", &image.height_px, "Height of the image.", from_to(1, kMaxPixels)},
      {"centre_px", &image.centre_px, "Point where the optical axis meets the image, [u, v].",
       from_to(-kMaxPixels, kMaxPixels)},
      {"beta", &image.beta, "Height of a pixel divided by its width.", from_to(0.1, 10)},
      {"azimuth_direction", &image.azimuth_direction,
       "Direction of growing azimuths in the image, 1 or -1: azimuth = azimuth_direction * atan2(v/beta - v0, u - u0) "
       "+ azimuth_offset_rad.",
       from_to(-1, 1)},
      {"azimuth_offset_rad", &image.azimuth_offset_rad, "Azimuth of the image's u axis.", from_to(-2 * kPi, 2 * kPi)},
      {"viewpoint_height_m", &image.viewpoint_height_m, "Height of the viewpoint above the floor.", above_to(0, 100)},
      {"sigma_px", &image.sigma_px, "Standard deviation of a detection in the image, along u and along v.",
       above_to(0, 1000)},
      {"detection_probability", &image.detection_probability, "Probability that something in view is detected.",
       above_to(0, 1)},
      {"mask_inner_px", &image.mask_inner_px, "Radius of the disc about the centre that robot and mounting hide.",
       from_to(0, kMaxPixels)},
      {"mask_outer_px", &image.mask_outer_px, "Radius of the mirror's rim.", above_to(0, kMaxPixels)},
      {"mask_polygons_px", &image.mask_polygons_px,
       "Other hidden parts of the image (struts, cables): polygons of three corners or more, [[[u, v], [u, v], [u, "
       "v]], ...].",
       from_to(-kMaxPixels, kMaxPixels)},
      {"theta_max_rad", &image.theta_max_rad, "Largest angle from the optical axis for which the model holds.",
       above_to(0, kPi)},
  };
}

std::vector<Key> camera_keys(CameraRig& camera) {
  return {
      {"sigma_bearing_rad", &camera.sigma_bearing_rad, "Standard deviation of one azimuth.", above_to(0, kPi)},
      {"identities", &camera.identities, "Bearings carry the identities of their landmarks."},
      {"field_of_view_rad", &camera.field_of_view_rad, "Full horizontal angle of view; 2 pi: all round.",
       above_to(0, 2 * kPi)},
      {"position_m", &camera.position_m,
       "Position of the camera's viewpoint on the robot, [x, y]: forward and to the left of the point whose pose "
       "odometry reports (on a robot with two driven wheels, the middle between them).",
       from_to(-kMaxMount_m, kMaxMount_m)},
      {"sigma_position_m", &camera.sigma_position_m,
       "Standard deviation of the viewpoint's position on the robot, along each axis; 0: exact.",
       from_to(0, kMaxMount_m)},
      {"yaw_offset_rad", &camera.yaw_offset_rad,
       "Angle from the robot's heading to the camera's azimuth 0, counter-clockwise.", from_to(-kPi, kPi)},
      {"sigma_yaw_rad", &camera.sigma_yaw_rad,
       "Standard deviation of the direction of the camera's azimuth 0: 0.05 for a camera that was mounted by eye, "
       "0.003 for one whose heading was calibrated from a drive; 0: exact.",
       from_to(0, 1)},
      {"roll_rad", &camera.roll_rad,
       "Roll of the camera about the robot's x axis (forward); a positive roll lifts the left side. Bearings from "
       "images are levelled by it, where the model knows elevations.",
       from_to(-kMostTilt_rad, kMostTilt_rad)},
      {"pitch_rad", &camera.pitch_rad,
       "Pitch of the camera about the robot's y axis (to the left), after the roll; a positive pitch lowers the front "
       "side.",
       from_to(-kMostTilt_rad, kMostTilt_rad)},
      {"sigma_tilt_rad", &camera.sigma_tilt_rad,
       "Standard deviation of roll_rad and of pitch_rad. The EKFs estimate the tilt from lamps and colours; with "
       "features and in fastslam it counts as noise. 0: exact. Not given: 0.02 with lamps (a camera that was mounted "
       "by eye), else 0, since a mirror's centre takes up most of a tilt.",
       from_to(0, kMostTilt_rad)},
      {"azimuths_clockwise", &camera.azimuths_clockwise,
       "Azimuths of ready-made bearings grow clockwise; for images, azimuth_direction says which way they grow."},
  };
}

Section camera_section(CameraRig& camera, ModelKeys& model) {
  return {"camera", "The camera's model, mounting and noise.",
          joined({{model_key(model)}, camera_keys(camera), image_keys(camera.image), parameter_keys(model)})};
}

Section odometry_section(OdometryRig& odometry) {
  return {
      "odometry",
      "Noise and calibration of the wheel odometry.",
      {
          choice<std::string>("kind", odometry.kind, {{"wheel_pose", "wheel_pose"}},
                              "Kind of the readings. wheel_pose: cumulative poses of the odometer."),
          {"lambda_distance_m", &odometry.lambda_distance_m, "Variance of the distance per metre driven [m^2/m].",
           from_to(0, 10)},
          {"lambda_rotation_rad", &odometry.lambda_rotation_rad, "Variance of a turn per radian turned [rad^2/rad].",
           from_to(0, 10)},
          {"lambda_drift_rad2_per_m", &odometry.lambda_drift_rad2_per_m, "Variance of the heading per metre driven.",
           from_to(0, 10)},
          {"sigma_lateral_m_per_sqrt_m", &odometry.sigma_lateral_m_per_sqrt_m,
           "Sideways slip: standard deviation after one metre.", from_to(0, 10)},
          {"floor_distance_m", &odometry.floor_distance_m,
           "Standard deviation that each step with motion adds to the distance.", from_to(0, 10)},
          {"floor_rotation_rad", &odometry.floor_rotation_rad,
           "Standard deviation that each step with motion adds to the heading.", from_to(0, kPi)},
          {"scale_distance", &odometry.scale_distance, "True distance divided by the reported one.", from_to(0.1, 10)},
          {"scale_turn", &odometry.scale_turn, "True turn divided by the reported one.", from_to(0.1, 10)},
          {"drift_rad_per_m", &odometry.drift_rad_per_m, "Heading gained for each metre driven.", from_to(-10, 10)},
          {"sigma_scale_distance", &odometry.sigma_scale_distance,
           "Standard deviation of scale_distance, as a share of scale_distance: bearings do not tell whether map and "
           "path are too large by this. 0.05 for an odometer that nobody has measured, 0.01 for one measured with a "
           "tape, 0.003 for one calibrated over a measured drive of tens of metres.",
           from_to(0, 0.5)},
          {"sigma_scale_turn", &odometry.sigma_scale_turn,
           "Standard deviation of scale_turn, as a share of scale_turn.", from_to(0, 0.5)},
          {"sigma_drift_rad_per_m", &odometry.sigma_drift_rad_per_m, "Standard deviation of drift_rad_per_m; 0: exact.",
           from_to(0, 1)},
          {"lag_s", &odometry.lag_s,
           "Lag of the odometry: the pose reported for time t is the robot's pose at t + lag_s.", from_to(-10, 10)},
          {"sigma_lag_s", &odometry.sigma_lag_s, "Standard deviation of lag_s; 0: exact.", from_to(0, 10)},
          {"clock_drift", &odometry.clock_drift,
           "Growth of lag_s per second since the first reading, for recordings by two clocks.", from_to(-0.1, 0.1)},
          {"wheels_swapped", &odometry.wheels_swapped,
           "The wheels are swapped: the odometer reports turns the other way round."},
      }};
}

/// Refuses a tilt where elevations are unknown: the effect of a tilt on an azimuth depends on the elevation.
void check_tilt(const CameraRig& camera, const std::string& file, FileErrors& violations) {
  if (tilt_of(camera).is_level() && camera.sigma_tilt_rad.value_or(0.0) == 0.0) return;
  constexpr std::string_view kKeys = "'camera.roll_rad', 'camera.pitch_rad' and 'camera.sigma_tilt_rad'";
  if (!takes_images(camera.model))
    violations.push_back({file, 0, fmt::format("{} are of images: bearings that come ready made are level", kKeys)});
  else if (std::holds_alternative<RadialRig>(camera.model))
    violations.push_back(
        {file, 0, fmt::format("{} need to know how high things are seen, which model \"radial\" does not", kKeys)});
}

void check_model(const Rig& rig, Section& camera, const std::string& file, FileErrors& violations) {
  for (const std::string_view key : needed_by(rig.camera.model)) {
    if (camera.find(key)->given) continue;
    violations.push_back(
        {file, 0, fmt::format("camera model \"{}\" needs the key '{}' in [camera]", name(rig.camera.model), key)});
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

Key model_key(ModelKeys& keys) {
  std::vector<std::pair<std::string_view, std::size_t>> words;
  for (const ModelRig& model : all_models()) words.emplace_back(name(model), model.index());
  return choice<std::size_t>(
      "model", keys.model, std::move(words),
      "Model of the camera. bearings: directions come ready made; radial: only azimuths are known; hyperbolic_mirror "
      "and parabolic_mirror: mirrors; pajdla, equidistant and polynomial: fisheyes.");
}

std::vector<Key> parameter_keys(ModelKeys& keys) {
  return {
      {"a_px", &keys.a_px, "Coefficient a of pajdla: r = a tan(theta/b) + c sin(theta/d).", from_to(-1e9, 1e9)},
      {"b", &keys.b, "Coefficient b of pajdla.", above_to(0, 1e6)},
      {"c_px", &keys.c_px, "Coefficient c of pajdla.", from_to(-1e9, 1e9)},
      {"d", &keys.d, "Coefficient d of pajdla.", above_to(0, 1e6)},
      {"mirror_a_mm", &keys.mirror_a_mm, "Semi-axis a of hyperbolic_mirror: z^2/a^2 - r^2/b^2 = 1.", above_to(0, 1e4)},
      {"mirror_b_mm", &keys.mirror_b_mm, "Semi-axis b of hyperbolic_mirror.", above_to(0, 1e4)},
      {"focal_length_px", &keys.focal_length_px,
       "Focal length of the camera of hyperbolic_mirror; for equidistant, pixels per radian.",
       above_to(0, kMaxModelPixels)},
      {"horizon_radius_px", &keys.horizon_radius_px,
       "Radius h of the horizon of parabolic_mirror: r = h tan(pi/4 + elevation/2).", above_to(0, kMaxModelPixels)},
      {"polynomial_a0", &keys.polynomial_a0,
       "Coefficient a0 of polynomial (OCamCalib): the angle from the axis is atan2(r, -(a0 + a1 r + ... + a4 r^4)), r "
       "in pixels.",
       from_to(-kMaxModelPixels, -1)},
      {"polynomial_a1", &keys.polynomial_a1, "Coefficient a1 of polynomial, usually 0.", from_to(-1e3, 1e3)},
      {"polynomial_a2", &keys.polynomial_a2, "Coefficient a2 of polynomial.", from_to(-1e3, 1e3)},
      {"polynomial_a3", &keys.polynomial_a3, "Coefficient a3 of polynomial.", from_to(-1e3, 1e3)},
      {"polynomial_a4", &keys.polynomial_a4, "Coefficient a4 of polynomial.", from_to(-1e3, 1e3)},
  };
}

ModelRig model_of(ModelKeys keys) {
  std::vector<Key> all = parameter_keys(keys);
  ModelRig model = all_models().at(keys.model);
  for (const ModelParameter& parameter : parameters(model))
    *parameter.value = member(all, parameter.key).value_or(*parameter.value);
  return model;
}

ModelKeys keys_of(ModelRig model) {
  ModelKeys keys;
  keys.model = model.index();
  std::vector<Key> all = parameter_keys(keys);
  for (const ModelParameter& parameter : parameters(model))
    if (!std::isnan(*parameter.value)) member(all, parameter.key) = *parameter.value;
  return keys;
}

std::vector<std::string_view> needed_by(ModelRig model) {
  std::vector<std::string_view> keys;
  if (takes_images(model)) keys.emplace_back("centre_px");
  for (const ModelParameter& parameter : parameters(model))
    if (parameter.is_needed) keys.push_back(parameter.key);
  if (looks_up(model)) keys.emplace_back("theta_max_rad");
  return keys;
}

RigKeys keys_of(const Rig& rig) { return {rig, keys_of(rig.camera.model)}; }

std::vector<Section> rig_sections(RigKeys& keys) {
  return {top_section(keys.rig), camera_section(keys.rig.camera, keys.model), odometry_section(keys.rig.odometry)};
}

FileResult<Rig> read_rig(std::string_view text, const std::string& file) {
  RigKeys keys;
  Rig& rig = keys.rig;
  std::vector<Section> sections = rig_sections(keys);
  const std::vector<Section*> tables = pointers(sections);
  FileErrors violations = read_toml(text, file, tables);
  rig.camera.model = model_of(keys.model);
  check_tilt(rig.camera, file, violations);
  check_model(rig, *std::ranges::find(sections, "camera", &Section::name), file, violations);
  if (!violations.empty()) return failure(std::move(violations));
  return rig;
}

FileResult<Rig> read_rig_file(const std::filesystem::path& file) {
  return file_text(file).and_then([&](const std::string& text) { return read_rig(text, file.string()); });
}

std::string rig_text(const Rig& rig) {
  RigKeys keys = keys_of(rig);
  std::string text;
  for (const Section& section : rig_sections(keys)) {
    if (!section.name.empty()) text += fmt::format("\n[{}]\n", section.name);
    for (const Key& key : section.keys) {
      if (const std::string value = key.value_text(); !value.empty())
        text += fmt::format("{} = {}  # {}\n", key.name, value, key.help);
    }
  }
  return text;
}

}  // namespace azimuth
