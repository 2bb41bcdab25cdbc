#include "slam/planar/ekf_choices.hpp"

#include <algorithm>

#include "slam/estimator/odometry_floors.hpp"

namespace azimuth {
namespace {

constexpr int kSightings = 3, kSightingsInImages = 8;  // until a landmark is believed to be one

}  // namespace

bool names_by_looks(const Rig& rig) { return rig.front_end == FrontEnd::sift && !rig.camera.identities; }

bool names_landmarks(const Rig& rig) { return rig.camera.identities || names_by_looks(rig); }

EkfSettings settings_for(const Rig& rig, EkfSettings settings) {
  if (settings.kl_threshold <= 0.0) settings.kl_threshold = printed_kl_threshold(rig.camera.sigma_bearing_rad);
  if (settings.confirm_after_sightings == 0)
    settings.confirm_after_sightings = rig.front_end == FrontEnd::bearings ? kSightings : kSightingsInImages;
  if (!names_by_looks(rig)) return settings;
  settings.min_observations = std::max(settings.min_observations, settings.identity.min_observations);
  settings.max_iterations = std::min(settings.max_iterations, settings.identity.max_iterations);
  return settings;
}

Initialisation chosen_initialisation(const Rig& rig, const EkfSettings& settings) {
  if (settings.initialisation == Initialisation::undelayed || !names_landmarks(rig)) return Initialisation::undelayed;
  if (settings.initialisation == Initialisation::delayed) return Initialisation::delayed;
  // The quality test compares parallax with the bearing's noise and is spoilt by the heading's. In a narrow view, or
  // when a metre of odometry turns the heading by more than a bearing's error, it never passes (SPEC part V). Without
  // identities bearings of an unmapped landmark cannot be told apart.
  const bool all_round = rig.camera.field_of_view_rad > kPi;
  const double heading_variance_of_a_metre =
      rig.odometry.lambda_drift_rad2_per_m + rig.odometry.floor_rotation_rad * rig.odometry.floor_rotation_rad;
  const bool steady = heading_variance_of_a_metre < rig.camera.sigma_bearing_rad * rig.camera.sigma_bearing_rad;
  return all_round && steady ? Initialisation::delayed : Initialisation::undelayed;
}

/// A narrow view shows one or two landmarks at a time, which proves little: it takes a prediction within a tenth of a
/// radian to believe that one is seen again. All round, the bearings of an image confirm each other; and in the first
/// metres, when most is decided, an image shows two or three things that no image has shown before.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings) {
  if (settings.new_density_per_rad > 0.0) return settings.new_density_per_rad;
  if (rig.camera.field_of_view_rad <= kPi) return 4.0;
  return rig.front_end == FrontEnd::bearings ? 0.16 : 0.4;
}

BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings,
                                   const std::optional<SecondBeginning>& again) {
  BearingEkfSettings filter;
  filter.retraction = settings.invariant_update ? JointState::Retraction::invariant : JointState::Retraction::additive;
  filter.max_iterations = settings.max_iterations;
  filter.iterate_below_heading_rad = settings.iterate_below_heading_rad;
  filter.min_distance_m = settings.min_distance_m;
  filter.yaw_offset_rad = rig.camera.yaw_offset_rad;
  filter.estimate_yaw = settings.estimate_camera_yaw;
  filter.sigma_yaw_rad = settings.sigma_camera_yaw_rad;
  if (rig.front_end != FrontEnd::bearings) filter.sigma_centre_px = settings.sigma_camera_centre_px;
  filter.charge_curvature = settings.charge_curvature && rig.front_end != FrontEnd::bearings;
  if (settings.consider_scales) filter.sigma_scales = sigma_scales(rig.odometry);
  if (again) {
    filter.centre_px = again->centre_px;
    filter.sigma_centre_px = again->sigma_centre_px;
  }
  return filter;
}

}  // namespace azimuth
