#include "slam/hindsight/make_smoother_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/estimator/start_from_map.hpp"
#include "slam/geometry/wrong_rig.hpp"
#include "slam/hindsight/late_mapper.hpp"
#include "slam/hindsight/named_mapper.hpp"
#include "slam/hindsight/nameless_mapper.hpp"
#include "slam/hindsight/smoother_estimator.hpp"
#include "slam/hindsight/with_hindsight.hpp"

namespace azimuth {
namespace {

constexpr CalibrationPriors kIfWrong{.sigma_scale_turn = wrong_rig::kScaleTurn,
                                     .sigma_drift_rad_per_m = wrong_rig::kDrift_rad_per_m,
                                     .sigma_camera_yaw_rad = wrong_rig::kYaw_rad,
                                     .sigma_lag_s = wrong_rig::kLag_s,
                                     .sigma_camera_m = wrong_rig::kCamera_m};
constexpr double kStricterKernel = 2.0 / 3.0;  // factor on the kernel width of the second member

CalibrationPriors calibration_of(const Rig& rig) {
  return {.sigma_scale_turn = rig.odometry.sigma_scale_turn,
          .sigma_drift_rad_per_m = rig.odometry.sigma_drift_rad_per_m,
          .sigma_camera_yaw_rad = rig.camera.sigma_yaw_rad,
          .sigma_lag_s = rig.odometry.sigma_lag_s,
          .sigma_camera_m = rig.camera.sigma_position_m};
}

SmootherSettings graph_settings(const Rig& rig, const HindsightSettings& settings) {
  SmootherSettings graph;
  graph.inverse_depth_mean_per_m = settings.inverse_depth_mean_per_m;
  graph.inverse_depth_sigma_per_m = settings.inverse_depth_sigma_per_m;
  graph.kernel = settings.kernel;
  graph.kernel_width = settings.kernel_width;
  graph.max_iterations = settings.max_iterations;
  graph.calibration = calibration_of(rig);
  return graph;
}

MotionFloors floors_of(const OdometryRig& odometry) {
  return {.distance_m = odometry.floor_distance_m, .rotation_rad = odometry.floor_rotation_rad};
}

KnownNamesSettings names_settings(const Rig& rig, const HindsightSettings& settings) {
  KnownNamesSettings names;
  names.smoother = graph_settings(rig, settings);
  names.sigma_bearing_rad = rig.camera.sigma_bearing_rad;
  names.thinning_s = settings.thinning_s;
  names.reinitialise_after = settings.reinitialise_after;
  names.max_keyframes = settings.max_keyframes;
  names.floors = floors_of(rig.odometry);
  if (settings.doubt_rig) names.doubts = {.if_wrong = kIfWrong, .noise = true};
  return names;
}

/// Makes a mapper for landmarks with identities. If `several` is set, it has a second member with a stricter kernel.
std::unique_ptr<Mapper> named_mapper(const Rig& rig, const HindsightSettings& settings) {
  const KnownNamesSettings names = names_settings(rig, settings);
  std::vector<KnownNamesSettings> members{names};
  if (settings.several) {
    members.push_back(names);
    members.back().smoother.kernel_width = kStricterKernel * names.smoother.kernel_width;
  }
  return std::make_unique<NamedMapper>(members, settings.confirm_after_bearings);
}

/// Number of images to keep. The smaller the field of view, the more images are needed to tell places apart.
int kept_images(int of_all_round, const Scene& scene) {
  return static_cast<int>(std::lround(of_all_round * scene.images_for_all_round()));
}

std::unique_ptr<Mapper> nameless_mapper(const Rig& rig, const HindsightSettings& settings, const Helpers& helpers) {
  NamelessSettings nameless;
  nameless.thinning_s = settings.nameless_thinning_s;
  nameless.floors = floors_of(rig.odometry);
  nameless.beam = beam_settings_for(rig.camera.sigma_bearing_rad, rig.camera.field_of_view_rad);
  nameless.max_keyframes = kept_images(settings.nameless_max_keyframes, nameless.beam.hypothesis.scene);
  if (settings.members > 0) nameless.beam.members = settings.members;
  nameless.sigma_scale_distance = rig.odometry.sigma_scale_distance;
  nameless.sigma_scale_turn = rig.odometry.sigma_scale_turn;
  nameless.rig = calibration_of(rig);
  if (settings.doubt_rig) nameless.rig_if_wrong = kIfWrong;
  return std::make_unique<LateMapper>(
      std::make_unique<NamelessMapper>(nameless, helpers.make_workers(settings.threads)), helpers.make_task_runner());
}

double considered_scale(const Rig& rig, const HindsightSettings& settings) {
  return settings.consider_distance ? rig.odometry.sigma_scale_distance : 0.0;
}

}  // namespace

std::unique_ptr<Estimator> make_smoother_estimator(const Rig& rig, const HindsightSettings& settings,
                                                   const MapStart& start, const HealthSettings& health,
                                                   const RelocalisationSettings& relocalisation,
                                                   const Helpers& helpers) {
  const bool named = rig.camera.identities && settings.names;
  const SmootherEstimatorSettings outside{
      .named = named,
      .confirm_after_bearings = settings.confirm_after_bearings,
      .sigma_scale_distance = considered_scale(rig, settings),
      .health = health,
      .relocalisation = relocalisation,
  };
  return std::make_unique<SmootherEstimator>(
      rig, outside, named ? named_mapper(rig, settings) : nameless_mapper(rig, settings, helpers), start);
}

std::unique_ptr<Estimator> make_with_hindsight(std::unique_ptr<Estimator> filter, const Rig& rig,
                                               const HindsightSettings& settings) {
  return std::make_unique<WithHindsight>(std::move(filter), rig, names_settings(rig, settings),
                                         considered_scale(rig, settings));
}

std::optional<std::string_view> why_unfit_for_smoother(const MapSnapshot& map, const Rig& rig,
                                                       const HindsightSettings& settings, const MapStart& start) {
  if (start.mode == MapMode::localise)
    return "estimator \"smoother\" corrects the map it starts from: estimator = \"ekf\" can leave it as it is";
  if (std::ranges::any_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have heights, and estimator \"smoother\" maps the plane";
  const bool looks_at_names = rig.camera.identities && settings.names;
  if (looks_at_names || map.names == MapNames::looks) return why_names_do_not_fit(map, rig);
  if (map.names == MapNames::sensor)
    return rig.camera.identities ? "its landmarks have names, which smoother.names = false leaves aside"
                                 : why_names_do_not_fit(map, rig);
  return start.pose_known ? std::nullopt : std::optional(kPoseIsNeeded);
}

}  // namespace azimuth
