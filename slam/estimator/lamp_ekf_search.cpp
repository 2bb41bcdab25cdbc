// LampEkfEstimator: how a robot that may be anywhere is found in the map.

#include <algorithm>
#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"

namespace azimuth {
namespace {

// A robot that is lost can be anywhere, facing anywhere.
constexpr double kAnywhere_m = 100.0;
constexpr std::size_t kFewestToPlace = 3;  // lamps in an image that place the robot better than the search did
// How far that image may put it from there: little enough to be linear in.
constexpr double kNear_m = 0.5, kNear_rad = 0.2;
constexpr double kDoubtfulFactor = 4.0;  // of a covariance that takes the lamps' errors as independent

Eigen::Matrix3d independent(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

}  // namespace

/// As high and as far as the camera sees.
CameraView LampEkfEstimator::camera_view() const {
  double highest_m = 0.0;
  for (const Lamp& lamp : lamps_)
    if (lamp.confirmed) highest_m = std::max(highest_m, ekf_.point(lamp.at).p_map_lamp_m.z());
  CameraView view;
  view.height_m = ekf_.camera_height_m();
  view.min_elevation_rad = kPi / 2.0 - max_zenith_rad_;
  view.rim = settings_.inner_margin;
  view.max_distance_m = std::max(0.0, highest_m - view.height_m) * std::tan(max_zenith_rad_);
  view.detection_probability = 1.0 - std::exp(log_missed_);
  return view;
}

/// The map is left as it is until the robot is found in it.
void LampEkfEstimator::begin_search() {
  std::vector<KnownLandmark> known;
  for (const Lamp& lamp : lamps_) {
    if (!lamp.confirmed) continue;
    const LampPoint point = ekf_.point(lamp.at);
    known.push_back({.p_map_m = point.p_map_lamp_m, .covariance_m2 = point.covariance_m2, .identity = lamp.identity});
  }
  relocaliser_.start(known, camera_view());
  ekf_.place_robot(ekf_.state().pose(), independent(kAnywhere_m, kPi));
  searching_ = true;
}

void LampEkfEstimator::search(const BearingSet& bearings) {
  directions_seen_.clear();
  for (const MeasuredDirection& measured : measured_) {
    const Eigen::Vector2d m = measured.seen.offset_per_metre();
    const double zenith_rad = std::atan(m.norm());
    directions_seen_.push_back({.azimuth_rad = std::atan2(m.y(), m.x()),
                                .sigma_rad = std::sqrt(measured.seen.variance().x()) / std::sin(zenith_rad),
                                .elevation_rad = kPi / 2.0 - zenith_rad,
                                .sigma_elevation_rad = std::sqrt(measured.seen.variance().y()),
                                .identity = measured.identity});
  }
  relocaliser_.update(directions_seen_);
  if (const auto found = relocaliser_.found()) settle_at(*found, bearings);
}

/// The lamps of the last image are told apart by the pose that was found, and then place the robot: as if nothing had
/// been known of its pose, so that it is correlated with the map as it should be.
void LampEkfEstimator::settle_at(const PoseHypothesis& found, const BearingSet& bearings) {
  const Eigen::Matrix3d covariance = kDoubtfulFactor * found.covariance;
  ekf_.place_robot(found.T_map_body, covariance);
  recognise();
  const auto pairs = std::ranges::count(matches_, DirectionFate::paired, &DirectionMatch::fate);
  if (static_cast<std::size_t>(pairs) >= kFewestToPlace)
    ekf_.place_robot(found.T_map_body, covariance + independent(kNear_m, kNear_rad));
  searching_ = false;
  ++counts_.recovered;
  contradictions_ = doubts_ = deaf_streaks_ = 0;
  last_accepted_m_ = last_judged_m_ = path_m_;
  apply_matches(bearings);
}

std::string_view LampEkfEstimator::why_lost() const {
  if (relocaliser_.is_ambiguous()) return "several places on the map look alike";
  return "looking for the robot's place on the map";
}

}  // namespace azimuth
