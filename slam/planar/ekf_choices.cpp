#include "slam/planar/ekf_choices.hpp"

#include <algorithm>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/estimator/rig_noise.hpp"

namespace azimuth {
namespace {

constexpr int kSightings = 3, kSightingsInImages = 8;  // bearings until a landmark is confirmed
// Prior of the image's centre for features. An error of the centre in their first images corresponds to an error of the
// distances with which they are initialised; many such features soon seem to determine the centre (mathematics VI.37).
constexpr double kCentreOfFeatures_px = 2.0;

/// Estimates the tilt as a state. Not for features: like the centre, the tilt would seem to be determined by many
/// features that are initialised with wrong distances. Leaving the remaining tilt unestimated does less harm
/// (mathematics VI.34).
void estimate_tilt(const CameraRig& rig, BearingEkfSettings& filter) {
  std::string ignored;  // the rig has no camera model with elevations
  const auto camera = camera_of(rig, ignored);
  if (!camera) return;
  filter.sigma_tilt_rad = sigma_tilt_rad(rig);
  filter.profile = camera->profile();
}

}  // namespace

bool names_by_looks(const Rig& rig) { return rig.front_end == FrontEnd::sift && !rig.camera.identities; }

bool names_landmarks(const Rig& rig) { return rig.camera.identities || names_by_looks(rig); }

EkfSettings settings_for(const Rig& rig, EkfSettings settings) {
  if (settings.delayed.kl_threshold <= 0.0)
    settings.delayed.kl_threshold = printed_kl_threshold(rig.camera.sigma_bearing_rad);
  if (settings.probation.confirm_after_sightings == 0)
    settings.probation.confirm_after_sightings = rig.front_end == FrontEnd::bearings ? kSightings : kSightingsInImages;
  if (!names_by_looks(rig)) return settings;
  settings.delayed.min_observations = std::max(settings.delayed.min_observations, settings.identity.min_observations);
  settings.update.max_iterations = std::min(settings.update.max_iterations, settings.identity.max_iterations);
  return settings;
}

Initialisation chosen_initialisation(const Rig& rig, const EkfSettings& settings) {
  if (settings.initialisation == Initialisation::undelayed || !names_landmarks(rig)) return Initialisation::undelayed;
  if (settings.initialisation == Initialisation::delayed) return Initialisation::delayed;
  // The quality test compares parallax with the bearing's noise, and heading noise spoils it. In a narrow view, or when
  // a metre of odometry turns the heading by more than a bearing's error, the test never passes (mathematics part V).
  // Without identities, bearings of an unmapped landmark cannot be told apart.
  const bool all_round = rig.camera.field_of_view_rad > kPi;
  const double heading_variance_of_a_metre =
      rig.odometry.lambda_drift_rad2_per_m + rig.odometry.floor_rotation_rad * rig.odometry.floor_rotation_rad;
  const bool steady = heading_variance_of_a_metre < rig.camera.sigma_bearing_rad * rig.camera.sigma_bearing_rad;
  return all_round && steady ? Initialisation::delayed : Initialisation::undelayed;
}

/// A narrow view shows one or two landmarks at a time, which is weak evidence: only a prediction within a tenth of a
/// radian counts as the same landmark. All round, the bearings of an image confirm each other. In the first metres,
/// where most associations are decided, an image shows two or three new landmarks.
double chosen_new_density_per_rad(const Rig& rig, const EkfSettings& settings) {
  if (settings.unnamed.new_density_per_rad > 0.0) return settings.unnamed.new_density_per_rad;
  if (rig.camera.field_of_view_rad <= kPi) return 4.0;
  return rig.front_end == FrontEnd::bearings ? 0.16 : 0.4;
}

BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings, const std::optional<Restart>& again) {
  BearingEkfSettings filter;
  filter.retraction = settings.update.invariant ? JointState::Retraction::invariant : JointState::Retraction::additive;
  filter.max_iterations = settings.update.max_iterations;
  filter.iterate_below_heading_rad = settings.update.iterate_below_heading_rad;
  filter.min_distance_m = settings.min_distance_m;
  filter.yaw_offset_rad = rig.camera.yaw_offset_rad;
  filter.estimate_yaw = settings.camera_yaw.estimate;
  filter.sigma_yaw_rad = settings.camera_yaw.sigma_rad;
  if (rig.front_end != FrontEnd::bearings) filter.sigma_centre_px = settings.centre.sigma_px;
  if (names_by_looks(rig)) filter.sigma_centre_px = std::min(filter.sigma_centre_px, kCentreOfFeatures_px);
  // For a mirror, the centre absorbs most of a tilt (mathematics VI.34). The tilt is therefore estimated only if the
  // rig gives its standard deviation.
  if (rig.front_end != FrontEnd::bearings && !names_by_looks(rig) && rig.camera.sigma_tilt_rad)
    estimate_tilt(rig.camera, filter);
  filter.charge_curvature = settings.update.charge_curvature && rig.front_end != FrontEnd::bearings;
  if (settings.update.consider_scales) filter.sigma_considered = sigma_considered(rig);
  if (filter.estimate_yaw) filter.sigma_considered(considered::yaw) = 0.0;
  if (again) {
    filter.camera_errors = again->camera_errors;
    filter.sigma_centre_px = again->sigma_centre_px;
  }
  return filter;
}

}  // namespace azimuth
