#include "slam/estimator/judgement.hpp"

#include <algorithm>
#include <cmath>

#include "slam/estimator/sample_watch.hpp"
#include "slam/geometry/wrong_rig.hpp"

namespace azimuth {
namespace {

constexpr int kStreaksUntilLost = 3;
constexpr int kContradictionsUntilDegraded = 3;
constexpr int kTroubledImagesUntilDegraded = 3;  // a flash or a torn frame is not worth a report
// The pose covariance counts from the map's origin and so grows with the map's reach: a value that is large in a room
// is small in a park. A heading uncertainty of 0.2 rad, the limit of `degraded`, moves the far end of the map by a
// fifth of its reach.
constexpr double kDegradedInRoom_m = 0.5, kDegradedShareOfReach = 0.01;
constexpr double kLostInRoom_m = 5.0, kLostShareOfReach = 0.2, kLostAnywhere_m = 50.0;
constexpr double kCertainOffset_sigmas = 3.0;

struct Spread {
  double position_m, heading_rad;  // standard deviations
};

Spread spread(const Eigen::Matrix3d& covariance) {
  return {std::sqrt(std::max(covariance(0, 0), covariance(1, 1))), std::sqrt(covariance(2, 2))};
}

double degraded_sigma_m(const HealthSettings& settings, double map_reach_m) {
  if (settings.degraded_sigma_m > 0.0) return settings.degraded_sigma_m;
  return std::max(kDegradedInRoom_m, kDegradedShareOfReach * map_reach_m);
}

double lost_sigma_m(const HealthSettings& settings, double map_reach_m) {
  if (settings.lost_sigma_m > 0.0) return settings.lost_sigma_m;
  return std::clamp(kLostShareOfReach * map_reach_m, kLostInRoom_m, kLostAnywhere_m);
}

bool is_off_centre(const Evidence& evidence, const HealthSettings& settings) {
  if (!evidence.camera || settings.degraded_centre_px <= 0.0) return false;
  const auto [mean_px, covariance_px2] = evidence.camera->centre();
  const double offset_px = mean_px.norm(), sigma_px = std::sqrt(covariance_px2.diagonal().maxCoeff());
  return offset_px > settings.degraded_centre_px && offset_px > kCertainOffset_sigmas * sigma_px;
}

bool is_late(const Evidence& evidence, const HealthSettings& settings) {
  if (!evidence.lag || settings.degraded_lag_s <= 0.0) return false;
  const double lag_s = std::abs(evidence.lag->mean_s);
  return lag_s > settings.degraded_lag_s && lag_s > kCertainOfRig_sigmas * evidence.lag->sigma_s;
}

std::string_view why_lost(const Evidence& evidence, const HealthSettings& settings) {
  if (evidence.inflations >= kStreaksUntilLost) return "bearings keep contradicting the map";
  if (is_too_uncertain(evidence.pose_covariance, settings, evidence.map_reach_m))
    return "the pose is too uncertain to be used";
  return "";
}

std::string_view why_degraded(const Evidence& evidence, const HealthSettings& settings) {
  if (evidence.troubled_images >= kTroubledImagesUntilDegraded) return to_string(evidence.trouble);
  if (evidence.inflations > 0 || evidence.contradictions >= kContradictionsUntilDegraded)
    return "bearings contradict the map";
  if (evidence.unrecognised_m > settings.degraded_after_m) return "no landmark recognised for long";
  const Spread sigma = spread(evidence.pose_covariance);
  if (sigma.position_m > degraded_sigma_m(settings, evidence.map_reach_m) ||
      sigma.heading_rad > settings.degraded_sigma_heading_rad)
    return "the pose is uncertain";
  if (evidence.landmarks >= evidence.max_landmarks) return "the map is full";
  if (is_off_centre(evidence, settings)) return "the image's centre is not where the rig says";
  if (is_tilted(evidence.camera, settings)) return "the camera leans otherwise than the rig says";
  if (is_late(evidence, settings)) return "images and odometry are not of the same time";
  if (evidence.rig_contradicted) return to_string(SampleTrouble::rig_contradicted);
  return "";
}

}  // namespace

/// Judges the magnitude of the tilt, against the larger of the standard deviations of roll and pitch.
bool is_tilted(const std::optional<CameraErrors>& camera, const HealthSettings& settings) {
  if (!camera || settings.degraded_tilt_rad <= 0.0) return false;
  const double tilt_rad = camera->mean.tail<2>().norm();
  const double sigma_rad = std::sqrt(camera->covariance.diagonal().tail<2>().maxCoeff());
  return tilt_rad > settings.degraded_tilt_rad && tilt_rad > kCertainOffset_sigmas * sigma_rad;
}

/// A covariance that is not finite counts as too uncertain.
bool is_too_uncertain(const Eigen::Matrix3d& pose_covariance, const HealthSettings& settings, double map_reach_m) {
  const Spread sigma = spread(pose_covariance);
  const bool is_certain =
      sigma.position_m <= lost_sigma_m(settings, map_reach_m) && sigma.heading_rad <= settings.lost_sigma_heading_rad;
  return !is_certain || !pose_covariance.allFinite();
}

Judgement judge(const Evidence& evidence, const HealthSettings& settings) {
  if (evidence.landmarks == 0) {
    const bool blind = evidence.troubled_images >= kTroubledImagesUntilDegraded;
    return {Health::starting, blind ? to_string(evidence.trouble) : "no landmark mapped yet"};
  }
  if (const std::string_view reason = why_lost(evidence, settings); !reason.empty()) return {Health::lost, reason};
  const std::string_view reason = why_degraded(evidence, settings);
  return {reason.empty() ? Health::tracking : Health::degraded, reason};
}

}  // namespace azimuth
