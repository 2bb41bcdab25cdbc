#include "tests/support/lamp_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numeric>

#include "drivers/storage/run.hpp"
#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "slam/geometry/rigid_alignment.hpp"
#include "slam/particles/fastslam_estimator.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr int kImages = 320;
constexpr double kStride_m = 0.265;
constexpr double kClutterPerImage = 0.4;
constexpr std::size_t kLastImages = 25;
constexpr double kSightingIsOf_rad = 0.06;  // a sighting within this angle of a lamp's true direction is of this lamp

MotionNoise noise_of(const OdometryRig& rig) { return {rig.lambda_distance_m, rig.lambda_rotation_rad, 0.0, 0.0}; }

/// Pose of the robot on its ellipse at image number `image`.
Pose2 pose_at(int image) {
  constexpr double kHalfWidth_m = 7.0, kHalfDepth_m = 5.0;
  double t = -kPi / 2.0;
  const auto slope = [](double at) { return std::hypot(kHalfWidth_m * std::sin(at), kHalfDepth_m * std::cos(at)); };
  constexpr int kParts = 20;
  for (int i = 0; i < image * kParts; ++i) t += kStride_m / kParts / slope(t);
  return {18.0 + kHalfWidth_m * std::cos(t), 1.25 + kHalfDepth_m * std::sin(t),
          wrap(std::atan2(kHalfDepth_m * std::cos(t), -kHalfWidth_m * std::sin(t)))};
}

Motion noisy_motion(const Pose2& from, const Pose2& to, const OdometryRig& rig, RandomDraws& draws) {
  const Control control = control_between(from, to);
  const Eigen::Vector4d variances = control_variances(control, noise_of(rig));
  const Control measured{control.distance_m + draws.normal(std::sqrt(variances(0))),
                         control.first_turn_rad + draws.normal(std::sqrt(variances(1))),
                         control.second_turn_rad + draws.normal(std::sqrt(variances(2)))};
  Motion motion;
  append(motion, measured, measured, noise_of(rig));
  return motion;
}

void look(LampRun& run, const CameraModel& camera, RandomDraws& draws) {
  const ImageRig& image = run.rig.camera.image;
  BearingSet& set = run.sets.emplace_back();
  set.stamp = Stamp{std::chrono::seconds(run.sets.size())};
  std::vector<int>& lamp_of = run.lamp_of.emplace_back();
  const auto see = [&](const std::optional<Pixel>& pixel, int lamp) {
    if (!pixel) return;
    const double v = draws.normal(), u = draws.normal();
    const Pixel noisy = *pixel + *image.sigma_px * Pixel(u, v);
    const auto seen = camera.direction(noisy);
    if (!seen) return;
    set.bearings.push_back({.azimuth_rad = seen->azimuth_rad, .elevation_rad = seen->elevation_rad});
    lamp_of.push_back(lamp);
  };
  for (std::size_t i = 0; i < run.lamps.size(); ++i) {
    const Eigen::Vector2d flat = inverse(run.truth.back()) * Eigen::Vector2d(run.lamps[i].head<2>());
    if (!draws.chance(*image.detection_probability)) continue;
    see(camera.pixel(Eigen::Vector3d(flat.x(), flat.y(), run.lamps[i].z() - *image.viewpoint_height_m)),
        static_cast<int>(i));
  }
  if (draws.chance(kClutterPerImage))
    see(camera.pixel(Direction{draws.uniform(-kPi, kPi), draws.uniform(0.4, 1.4)}), LampRun::kClutter);
}

void drive_along(LampRun& run, std::span<const Pose2> path, RandomDraws& draws) {
  std::string problem;
  const auto camera = camera_of(run.rig.camera, problem);
  for (const Pose2& pose : path) {
    run.motions.push_back(run.truth.empty() ? Motion{} : noisy_motion(run.truth.back(), pose, run.rig.odometry, draws));
    run.truth.push_back(pose);
    look(run, *camera, draws);
  }
}

/// For each landmark: how often it was associated with each lamp.
using Sightings = std::map<std::int64_t, std::map<int, int>>;

/// The lamp with which a landmark was most often associated; kClutter: the landmark did not exist.
int lamp_meant(const Sightings& sightings, std::int64_t landmark) {
  const auto found = sightings.find(landmark);
  if (found == sightings.end()) return LampRun::kClutter;
  return std::ranges::max_element(found->second, {}, [](const auto& entry) { return entry.second; })->first;
}

/// An association is wrong if the landmark belongs to another lamp, or if it is new although its lamp was already
/// mapped.
void judge_recognition(const Sightings& before, std::int64_t landmark, int lamp, LampOutcome& outcome) {
  const int meant = lamp_meant(before, landmark);
  const bool was_mapped =
      std::ranges::any_of(before, [&](const auto& entry) { return lamp_meant(before, entry.first) == lamp; });
  if (meant == lamp)
    ++outcome.right;
  else if (meant != LampRun::kClutter || was_mapped)
    ++outcome.wrong;
}

void judge_map(std::span<const LandmarkEstimate> map, const LampRun& run, const Pose2& T_world_map,
               LampOutcome& outcome) {
  outcome.landmarks = map.size();
  for (const Eigen::Vector3d& lamp : run.lamps) {
    double nearest_m = kMapped_m;
    for (const LandmarkEstimate& landmark : map) {
      const Eigen::Vector2d flat = T_world_map * landmark.p_map_landmark_m;
      const Eigen::Vector3d p_world(flat.x(), flat.y(), landmark.z_map_landmark_m);
      nearest_m = std::min(nearest_m, (p_world - lamp).norm());
    }
    if (nearest_m < kMapped_m) outcome.lamp_errors_m.push_back(nearest_m);
  }
}

/// `lamps_of_bearings` returns the landmark that each bearing of the last image was associated with; negative: none.
LampOutcome drive(const LampRun& run, Estimator& estimator,
                  const std::function<std::span<const std::int64_t>()>& lamps_of_bearings) {
  LampOutcome outcome;
  Sightings sightings;
  Estimate estimate;
  std::vector<Eigen::Vector2d> estimated, truth;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
    estimate.landmarks.clear();
    estimator.estimate(estimate);
    estimated.push_back(estimate.T_map_body.position());
    truth.push_back(run.truth[i].position());
    if (i > 0) outcome.anees += squared_error(estimate, inverse(run.truth[0]) * run.truth[i]);
    const auto landmarks = lamps_of_bearings();
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      const int lamp = run.lamp_of[i][l];
      if (landmarks[l] < 0 || lamp == LampRun::kClutter) continue;
      if (i < run.sets.size() / 2) ++sightings[landmarks[l]][lamp];
      if (i + kLastImages >= run.sets.size()) judge_recognition(sightings, landmarks[l], lamp, outcome);
    }
  }
  outcome.anees /= static_cast<double>(run.sets.size() - 1);
  const Pose2 T_world_map = align(estimated, truth);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error_m = (T_world_map * estimated[i] - truth[i]).norm();
    outcome.position_mean_m += error_m / static_cast<double>(truth.size());
    outcome.position_max_m = std::max(outcome.position_max_m, error_m);
  }
  judge_map(estimate.landmarks, run, T_world_map, outcome);
  return outcome;
}

/// The lamp that a bearing from a known pose belongs to.
int lamp_seen(const LampRun& run, const Pose2& pose, const Bearing& bearing) {
  const Viewpoint from(pose, *run.rig.camera.image.viewpoint_height_m);
  const LampSighting seen = make_sighting(bearing.azimuth_rad, kPi / 2.0 - bearing.elevation_rad, {1.0, 0.0, 1.0});
  for (std::size_t i = 0; i < run.lamps.size(); ++i) {
    const Eigen::Vector2d off = innovation(view(from, run.lamps[i]), from, seen);
    const Eigen::Vector2d across(off.x() * seen.sin_zenith(), off.y());
    if (across.norm() < kSightingIsOf_rad) return static_cast<int>(i);
  }
  return LampRun::kClutter;
}

}  // namespace

Rig lamp_rig() {
  Rig rig;
  rig.camera.model = PajdlaRig{.a_px = 180.0, .b = 2.0, .c_px = 60.0, .d = 1.2};
  ImageRig& image = rig.camera.image;
  image.centre_px = PixelPoint{320.0, 240.0};
  image.theta_max_rad = degrees_to_rad(70.0);
  image.viewpoint_height_m = 1.8;
  image.sigma_px = 1.5;
  image.detection_probability = 0.85;
  rig.odometry.lambda_distance_m = 6.25e-4;
  rig.odometry.lambda_rotation_rad = 3.03e-4;
  return rig;
}

LampRun simulated_hall(std::uint64_t seed, double off_m) {
  RandomDraws draws(static_cast<unsigned>(seed));
  LampRun run;
  run.rig = lamp_rig();
  for (const double x : {4.5, 13.5, 22.5, 31.5})
    for (const double y : {-5.5, -1.0, 3.5, 8.0}) run.lamps.emplace_back(x, y, 6.5);
  if (off_m > 0.0)
    for (Eigen::Vector3d& lamp : run.lamps) {
      lamp.y() += draws.uniform(-off_m, off_m);
      lamp.x() += draws.uniform(-off_m, off_m);
    }
  std::vector<Pose2> path;
  for (int image = 0; image < kImages; ++image) path.push_back(pose_at(image));
  drive_along(run, path, draws);
  return run;
}

LampRun driven_hall(std::vector<Eigen::Vector3d> lamps, std::span<const Pose2> path, std::uint64_t seed) {
  RandomDraws draws(static_cast<unsigned>(seed));
  LampRun run;
  run.rig = lamp_rig();
  run.lamps = std::move(lamps);
  drive_along(run, path, draws);
  return run;
}

double squared_error(const Estimate& estimate, const Pose2& T_first_body) {
  Eigen::Vector3d error = estimate.T_map_body.vector() - T_first_body.vector();
  error.z() = wrap(error.z());
  const Eigen::Matrix3d P = estimate.pose_covariance + 1e-12 * Eigen::Matrix3d::Identity();
  return error.dot(P.ldlt().solve(error));
}

double LampOutcome::lamp_mean_m() const {
  return std::accumulate(lamp_errors_m.begin(), lamp_errors_m.end(), 0.0) / static_cast<double>(lamp_errors_m.size());
}

LampOutcome drive(const LampRun& run, const FastSlamSettings& settings) {
  FastSlamEstimator estimator(run.rig, settings);
  return drive(run, estimator, [&] { return estimator.filter().lamps_of_sightings(); });
}

LampOutcome drive(const LampRun& run, const LampEkfSettings& settings) {
  LampEkfEstimator estimator(run.rig, settings);
  return drive(run, estimator, [&] { return estimator.lamps_of_bearings(); });
}

LampRun recorded_hall(const std::filesystem::path& folder) {
  FileResult<Run> read = load_run(folder);
  LampRun run;
  if (!read) ADD_FAILURE() << folder;
  if (!read) return run;
  run.rig = *read_rig(read->rig_toml, read->rig_file);
  const OdometryRig& odometry = run.rig.odometry;
  for (const TrueLandmark& lamp : read->landmarks) run.lamps.emplace_back(lamp.x_m, lamp.y_m, lamp.z_m);
  std::size_t next = 0;
  for (std::size_t i = 0; i < read->odometry.size(); ++i) {
    Motion& motion = run.motions.emplace_back();
    if (i > 0) {
      const Control control = control_between(read->odometry[i - 1].T_odom_body, read->odometry[i].T_odom_body);
      append(motion, control, control, {odometry.lambda_distance_m, odometry.lambda_rotation_rad, 0.0, 0.0});
    }
    run.truth.push_back(read->truth[i].T_world_body);
    BearingSet& set = run.sets.emplace_back();
    set.stamp = read->odometry[i].stamp;  // the image may be empty
    if (next < read->bearings.size() && read->bearings[next].stamp == set.stamp) set = read->bearings[next++];
    std::vector<int>& lamp_of = run.lamp_of.emplace_back();
    for (const Bearing& bearing : set.bearings) lamp_of.push_back(lamp_seen(run, run.truth.back(), bearing));
  }
  return run;
}

}  // namespace azimuth
