#include "tools/lens_fit/lens_start.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "slam/estimator/mounted_estimator.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

constexpr double kLeastPath_m = 2.0;
constexpr double kLeastTurns_rad = kPi / 2.0;
constexpr std::size_t kLeastImages = 10;

/// The reason why the drive is too short or turns too little; empty if it suffices.
std::string why_too_little(const std::vector<Motion>& motions) {
  double path_m = 0.0;
  double least_rad = 0.0, most_rad = 0.0, heading_rad = 0.0;
  for (std::size_t i = 1; i < motions.size(); ++i) {
    path_m += motions[i].path_m;
    heading_rad += motions[i].T_start_end.heading_rad;
    least_rad = std::min(least_rad, heading_rad);
    most_rad = std::max(most_rad, heading_rad);
  }
  const double turned_rad = most_rad - least_rad;
  if (path_m < kLeastPath_m)
    return fmt::format(
        "the robot stands still, but for {:.1f} m by its odometry: a lens shows in how lamps go through the image, so "
        "drive some metres among them, and turn",
        path_m);
  if (turned_rad < kLeastTurns_rad)
    return fmt::format(
        "its headings differ by {:.0f} degrees only: where the lens's axis meets the image (camera.centre_px) shows "
        "when the robot turns, so turn by 90 degrees or more",
        turned_rad * 180.0 / kPi);
  return {};
}

std::string why_not_for(const Run& run, const Rig& rig, const FisheyeRequest& request) {
  if (run.frames.empty()) return "has no images: a lens is calibrated by where lamps are in them, in pixels";
  if (!request.field_of_view_rad && !looks_up(rig.camera.model))
    return fmt::format(
        "camera.model \"{}\" in {} does not look up at lamps: a mirror is for azimuth calibrate mirror; a fisheye "
        "whose "
        "model nobody knows yet begins with --field-of-view DEGREES",
        name(rig.camera.model), run.rig_file);
  if (request.lamp_height_m && !rig.camera.image.viewpoint_height_m)
    return "--lamp-height counts from the floor, so " + run.rig_file +
           " has to say how high the camera is: camera.viewpoint_height_m";
  if (request.lamp_height_m && *request.lamp_height_m < *rig.camera.image.viewpoint_height_m + 0.2)
    return fmt::format(
        "--lamp-height {:g}: must be above the camera, which is {:g} m above the floor "
        "(camera.viewpoint_height_m)",
        *request.lamp_height_m, *rig.camera.image.viewpoint_height_m);
  if (run.frames.size() < kLeastImages)
    return fmt::format("has {} image{} only: a lens takes {} or more", run.frames.size(),
                       run.frames.size() == 1 ? "" : "s", kLeastImages);
  return {};
}

/// Sets the model r = f theta, with f such that the field of view fills the image circle.
void begin_equidistant(double field_of_view_rad, CameraRig& camera) {
  const double theta_rad = 0.5 * field_of_view_rad;
  camera.model = EquidistantRig{image_radius_px(camera.image) / theta_rad};
  camera.image.theta_max_rad = theta_rad;
  camera.image.centre_px.reset();
}

}  // namespace

std::optional<FisheyeStart> fisheye_start(const Run& run, const Rig& rig, const FisheyeRequest& request,
                                          std::string& problem) {
  problem = why_not_for(run, rig, request);
  if (!problem.empty()) return std::nullopt;
  FisheyeStart start{.rig = rig, .lens = {}, .priors = {}, .motions = {}};
  const double unit_px = image_radius_px(rig.camera.image);
  if (!(unit_px > 0.0)) {
    problem = run.rig_file + " does not say how large images are: camera.width_px and camera.height_px";
    return std::nullopt;
  }
  if (request.field_of_view_rad) begin_equidistant(*request.field_of_view_rad, start.rig.camera);
  const auto lens = lens_of(start.rig.camera, unit_px, problem);
  if (!lens) {
    problem = run.rig_file + ": " + problem;
    return std::nullopt;
  }
  start.lens = *lens;
  std::vector<Stamp> stamps;
  for (const FrameFile& frame : run.frames) stamps.push_back(frame.stamp);
  for (const DriveMotion& each : motions_between(run.odometry, rig.odometry, stamps))
    start.motions.push_back(point_motion(mount_of(rig), each.motion));
  problem = why_too_little(start.motions);
  if (!problem.empty()) return std::nullopt;
  if (request.lamp_height_m) start.priors.lamp_height_m = *request.lamp_height_m - *rig.camera.image.viewpoint_height_m;
  start.priors.tilt = lens->tilt;
  start.priors.sigma_lamp_height_m = request.sigma_lamp_height_m;
  start.priors.sigma_one_lamp_m = request.sigma_one_lamp_m;
  start.priors.sigma_scale_distance = std::max(rig.odometry.sigma_scale_distance, 1e-5);
  start.priors.sigma_scale_turn = std::max(rig.odometry.sigma_scale_turn, 1e-5);
  return start;
}

}  // namespace azimuth
