#include "slam/planar/ekf_choices.hpp"

#include <algorithm>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/estimator/odometry_floors.hpp"

namespace azimuth {
namespace {

constexpr int kSightings = 3, kSightingsInImages = 8;  // until a landmark is believed to be one
// Of an image in which features are told apart: how far their first images show a centre to be off is how far off the
// distances are that they begin with, and where they are many these soon seem to know it (SPEC VI.37).
constexpr double kCentreOfFeatures_px = 2.0;

/// Not among features that are told apart: many that begin with wrong distances seem to tell it, as with the centre,
/// and what is left of it does less harm than that (SPEC VI.34).
void estimate_tilt(const CameraRig& rig, BearingEkfSettings& filter) {
  std::string ignored;  // of a rig that knows nothing of elevations
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
  if (settings.unnamed.new_density_per_rad > 0.0) return settings.unnamed.new_density_per_rad;
  if (rig.camera.field_of_view_rad <= kPi) return 4.0;
  return rig.front_end == FrontEnd::bearings ? 0.16 : 0.4;
}

BearingEkfSettings filter_settings(const Rig& rig, const EkfSettings& settings,
                                   const std::optional<SecondBeginning>& again) {
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
  // A mirror's centre takes up most of a tilt (SPEC VI.34), so that a second error like it is estimated only where the
  // rig says how well it is known.
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
