#include "tools/lens_fit/fisheye_calibration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "drivers/camera/run_images.hpp"
#include "slam/estimator/mounted_estimator.hpp"
#include "slam/perception/lamps/lamp_perception.hpp"
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

constexpr std::size_t kLeastLamps = 3;
constexpr double kLeastSpread_rad = 0.5;  // least range of the lamps' angles from the axis
constexpr double kMostMustFitLens = 0.5;  // least share of observations that fit
// Largest acceptable standard deviations of the centre and of radii.
constexpr double kMostCentre_px = 2.0;
constexpr double kMostRadius_px = 4.0;
constexpr double kAnyTilt_rad = 0.05;  // prior standard deviation of an unmeasured tilt
constexpr double kSurelyLeans = 18.4;  // chi squared with 2 degrees of freedom at a probability of 1e-4
constexpr double kBeyond_rad = 0.02;   // the lens is valid up to the largest observed angle plus this

/// Tracking gates for each round. They narrow as the lens improves.
constexpr std::array<TrackingGate, 4> kRounds{{{15.0, 3.0}, {8.0, 1.5}, {6.0, 1.0}, {6.0, 1.0}}};

std::vector<SeenLamps> look(const Run& run, const CameraRig& rig, const LampSettings& settings, std::string& problem) {
  LampPerception perception(rig, settings);
  RunImages images(run);
  BearingSet set;
  std::vector<SeenLamps> all;
  std::size_t readable = 0;
  for (std::size_t i = 0; i < images.count(); ++i) {
    SeenLamps& seen = all.emplace_back();
    const ImageView image = images.pixels(i, PixelFormat::gray8);
    if (image.bytes.empty()) {
      if (problem.empty()) problem = images.problem();
      continue;
    }
    perception.observe(image, set);
    readable += set.trouble != ImageTrouble::unreadable;
    for (const DetectedLamp& lamp : perception.lamps()) seen.push_back({lamp.pixel, lamp.covariance_px2});
  }
  if (readable > 0) problem.clear();
  if (readable == 0 && problem.empty())
    problem = "its images are of another size than camera.width_px and camera.height_px say";
  return all;
}

struct LikelyHeight {
  double height_m = 0.0;
  double cost = std::numeric_limits<double>::infinity();  ///< of following lamps of this height
};

/// Estimates an unmeasured lamp height: tries a range of heights and returns the one with the least tracking cost.
LikelyHeight likely_height(const FisheyeStart& start, const std::vector<SeenLamps>& images) {
  constexpr double kLowest_m = 0.8, kHighest_m = 20.0, kRatio = 1.2;
  LikelyHeight best{.height_m = kLowest_m};
  for (double height_m = kLowest_m; height_m < kHighest_m; height_m *= kRatio) {
    const double cost = map_lamps(start.motions, images, start.lens, height_m, kRounds.front()).cost;
    if (cost < best.cost) best = {height_m, cost};
  }
  return best;
}

/// Turns the camera as the lamps tell: by azimuths in either sense, from any of eight directions.
void turn_camera(const FisheyeStart& start, const std::vector<SeenLamps>& images, ImageRig& camera) {
  constexpr int kDirections = 8;
  double least = std::numeric_limits<double>::infinity();
  for (const int azimuth_direction : {-1, 1})
    for (int i = 0; i < kDirections; ++i) {
      FisheyeStart turned = start;
      turned.lens.axes.azimuth_direction = azimuth_direction;
      turned.lens.axes.azimuth_offset_rad = wrap(2.0 * kPi * i / kDirections);
      if (const double cost = likely_height(turned, images).cost; cost < least) {
        least = cost;
        camera.azimuth_direction = azimuth_direction;
        camera.azimuth_offset_rad = turned.lens.axes.azimuth_offset_rad;
      }
    }
}

double theta_seen(const LensDrive& drive, const LensSolution& solution) {
  double farthest_px = 0.0;
  for (std::size_t i = 0; i < drive.sightings.size(); ++i)
    if (solution.fits[i])
      farthest_px = std::max(farthest_px, solution.lens.axes.polar(drive.sightings[i].pixel).radius_px);
  return solution.lens.theta_rad(farthest_px);
}

/// A tilt and an offset of the image centre have similar effects, so estimating both makes both uncertain. The tilt
/// therefore keeps the rig's value unless the lamps contradict it.
std::optional<LensSolution> fitted(const LensFitStart& map, LensPriors priors, bool& tilt_found) {
  priors.sigma_tilt_rad = kAnyTilt_rad;
  const auto leaning = fit_lens(map.drive, map.start, priors);
  tilt_found = false;
  if (leaning) {
    const CameraTilt& tilt = leaning->lens.tilt;
    const Eigen::Vector2d off{tilt.roll_rad - priors.tilt.roll_rad, tilt.pitch_rad - priors.tilt.pitch_rad};
    const Eigen::Matrix2d covariance = leaning->covariance.block<2, 2>(kRoll, kRoll);
    tilt_found = off.dot(covariance.llt().solve(off)) > kSurelyLeans;
    if (tilt_found) return leaning;
  }
  priors.sigma_tilt_rad = 0.0;
  LensSolution start = map.start;
  start.lens.tilt = priors.tilt;
  return fit_lens(map.drive, start, priors);
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

std::string why_cannot_tell(const LensFitStart& map) {
  const std::size_t lamps = map.start.lamps.size();
  if (lamps < kLeastLamps)
    return fmt::format(
        "{} lamp{} could be followed from image to image, and it takes {} or more: drive where more of them are seen; "
        "[lamps] in azimuth.toml says what counts as one, azimuth replay --pictures shows it",
        lamps == 0 ? "no" : fmt::format("only {}", lamps), lamps == 1 ? "" : "s", kLeastLamps);
  double least_rad = kPi, most_rad = 0.0;
  for (const LampObservation& sighting : map.drive.sightings) {
    const double theta = map.start.lens.theta_rad(map.start.lens.axes.polar(sighting.pixel).radius_px);
    least_rad = std::min(least_rad, theta);
    most_rad = std::max(most_rad, theta);
  }
  if (most_rad - least_rad < kLeastSpread_rad)
    return fmt::format(
        "all lamps are seen between {:.0f} and {:.0f} degrees from the axis, which tells nothing of the rest of the "
        "lens (camera.polynomial_a0 to a4): drive below some, and away from them",
        least_rad * 180.0 / kPi, most_rad * 180.0 / kPi);
  return {};
}

std::string why_cannot_tell(const LensSolution& solution, double theta_seen_rad) {
  if (solution.fitting() < kMostMustFitLens)
    return fmt::format(
        "only {:.0f} % of the lamps' sightings fit any lens: the rig's first guess may be too far off "
        "(--field-of-view), its odometry wrong (azimuth calibrate odometry), or lamps are at different heights "
        "(--lamp-spread)",
        100.0 * solution.fitting());
  const double centre_px = std::sqrt(std::max(solution.covariance(0, 0), solution.covariance(1, 1)));
  if (!(centre_px < kMostCentre_px))
    return fmt::format(
        "the lens's centre (camera.centre_px) is known to +- {:.1f} px only: drive longer, and turn below lamps",
        centre_px);
  for (double theta = 0.2; theta < theta_seen_rad; theta += 0.1) {
    const double sigma_px = sigma_radius_px(solution.lens, solution.of_lens(), theta);
    if (!(sigma_px < kMostRadius_px))
      return fmt::format(
          "where lamps are seen {:.0f} degrees from the axis is known to +- {:.1f} px only (camera.polynomial_a0 to "
          "a4): drive "
          "longer, below lamps and away from them; see --lamp-height and odometry.sigma_scale_distance as well",
          theta * 180.0 / kPi, sigma_px);
  }
  return {};
}

std::optional<FisheyeCalibration> calibrate_fisheye(const Run& run, const Rig& rig, const LampSettings& settings,
                                                    const FisheyeRequest& request, std::string& problem) {
  auto start = fisheye_start(run, rig, request, problem);
  if (!start) return std::nullopt;
  FisheyeCalibration found;
  found.height_known = start->priors.lamp_height_m.has_value();
  CameraRig eye = start->rig.camera;
  double height_m = start->priors.lamp_height_m.value_or(0.0);
  for (const TrackingGate& trust : kRounds) {
    const std::vector<SeenLamps> images = look(run, eye, settings, problem);
    if (!problem.empty()) return std::nullopt;
    if (height_m == 0.0) height_m = likely_height(*start, images).height_m;
    LensFitStart map = map_lamps(start->motions, images, start->lens, height_m, trust);
    problem = why_cannot_tell(map);
    if (!problem.empty()) return std::nullopt;
    auto solution = fitted(map, start->priors, found.tilt_found);
    if (!solution) {
      problem = "its lamps do not determine the lens: drive longer, below lamps and away from them, and turn";
      return std::nullopt;
    }
    start->lens = solution->lens;
    height_m = solution->lamp_height_m;
    found.drive = std::move(map.drive);
    found.solution = std::move(*solution);
    const double sees_to_rad = eye.image.theta_max_rad.value_or(kPi / 2.0);
    eye = with_lens(eye, start->lens, theta_max_rad(start->lens, sees_to_rad));
  }
  found.theta_seen_rad = theta_seen(found.drive, found.solution);
  problem = why_cannot_tell(found.solution, found.theta_seen_rad);
  if (!problem.empty()) return std::nullopt;
  const double said_rad = start->rig.camera.image.theta_max_rad.value_or(kPi);
  found.theta_max_rad = theta_max_rad(start->lens, std::min(said_rad, found.theta_seen_rad + kBeyond_rad));
  found.rig = rig;
  found.rig.camera = with_lens(rig.camera, start->lens, found.theta_max_rad);
  return found;
}

std::optional<FisheyeCalibration> calibrate_unknown_fisheye(const Run& run, const OdometryRig& odometry,
                                                            const LampSettings& settings, std::string& problem) {
  FisheyeRequest half_of_the_world;
  half_of_the_world.field_of_view_rad = kPi;
  RunImages first(run);
  if (first.count() == 0) {
    problem = "has no images";
    return std::nullopt;
  }
  const ImageView image = first.pixels(0, PixelFormat::gray8);
  if (image.bytes.empty()) {
    problem = first.problem();
    return std::nullopt;
  }
  Rig rig;
  rig.odometry = odometry;
  rig.front_end = FrontEnd::lamps;
  rig.camera.image.width_px = image.format.width_px;
  rig.camera.image.height_px = image.format.height_px;
  const auto start = fisheye_start(run, rig, half_of_the_world, problem);
  if (!start) return std::nullopt;
  const std::vector<SeenLamps> images = look(run, start->rig.camera, settings, problem);
  if (!problem.empty()) return std::nullopt;
  turn_camera(*start, images, rig.camera.image);
  return calibrate_fisheye(run, rig, settings, half_of_the_world, problem);
}

}  // namespace azimuth
