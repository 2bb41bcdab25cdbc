// LampEkfEstimator: how it notices that the robot is lost, and finds it again.

#include <algorithm>
#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"
#include "slam/estimator/lost_robot.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewestLampsToPlace = 3;  // lamps in an image that place the robot better than the search did
constexpr double kSlip_m = 1.0, kSlip_rad = 0.3;
constexpr double kLeastOfRivals = 0.1;  // probability

Eigen::Matrix3d independent(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

}  // namespace

/// How many lamps of the map are in view, and how many directions are of one of those.
ImageAgreement LampEkfEstimator::agreement() const {
  if (crowded_ || confirmed() < kFewestEstablished) return {};
  ImageAgreement agreement{.bearings = static_cast<int>(measured_.size())};
  double gates_sr = 0.0;
  for (const Predicted& predicted : predicted_) {
    if (!is_due(predicted)) continue;
    // m is a tangent: towards the rim a step of it is a smaller angle.
    const double m2 = predicted.offset.m.squaredNorm();
    gates_sr += kPi * settings_.gate_chi2 * std::sqrt(predicted.covariance.determinant()) / std::pow(1.0 + m2, 1.5);
    ++agreement.expected;
  }
  for (const DirectionMatch& match : matches_)
    agreement.explained +=
        match.fate == DirectionFate::ambiguous || (match.fate == DirectionFate::paired && is_due(paired(match))) ? 1
                                                                                                                 : 0;
  agreement.chance = 1.0 - std::exp(-gates_sr / (2.0 * kPi * (1.0 - std::cos(max_zenith_rad_))));
  return agreement;
}

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
void LampEkfEstimator::begin_search(const std::optional<Whereabouts>& within) {
  std::vector<KnownLandmark> known;
  for (const Lamp& lamp : lamps_) {
    if (!lamp.confirmed) continue;
    const LampPoint point = ekf_.point(lamp.at);
    known.push_back({.p_map_m = point.p_map_lamp_m, .covariance_m2 = point.covariance_m2, .identity = lamp.identity});
  }
  relocaliser_.start(known, camera_view(), within);
  ekf_.place_robot(ekf_.state().pose(), independent(kAnywhere_m, kPi));
  watch_.settle();
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
  if (const auto found = relocaliser_.found()) return settle_at(*found, bearings);
  if (const auto slipped = nearby()) settle_at(*slipped, bearings);
}

/// Wheels slip more often than robots are carried to a place that looks the same: of several such places the one near
/// where odometry puts the robot is believed.
std::optional<PoseHypothesis> LampEkfEstimator::nearby() const {
  if (!was_tracking_ || !relocaliser_.is_ambiguous()) return std::nullopt;
  for (const PoseHypothesis& place : relocaliser_.hypotheses()) {
    const Pose2 off = inverse(ekf_.state().pose()) * place.T_map_body;
    if (off.position().norm() > kSlip_m || std::abs(off.heading_rad) > kSlip_rad) continue;
    const bool proven = place.images >= relocalisation_.found_images &&
                        place.driven_m >= relocalisation_.found_distance_m &&
                        place.explained >= relocalisation_.found_explained;
    if (proven && place.probability > kLeastOfRivals) return place;
  }
  return std::nullopt;
}

/// The lamps of the last image are told apart by the pose that was found, and then place the robot: as if nothing had
/// been known of its pose, so that it is correlated with the map as it should be.
void LampEkfEstimator::settle_at(const PoseHypothesis& found, const BearingSet& bearings) {
  const Eigen::Matrix3d covariance = kDoubtfulFactor * found.covariance;
  ekf_.place_robot(found.T_map_body, covariance);
  recognise();
  const auto pairs = std::ranges::count(matches_, DirectionFate::paired, &DirectionMatch::fate);
  if (static_cast<std::size_t>(pairs) >= kFewestLampsToPlace)
    ekf_.place_robot(found.T_map_body, covariance + independent(kNear_m, kNear_rad));
  searching_ = false;
  ++counts_.recovered;
  contradictions_ = doubts_ = deaf_streaks_ = 0;
  last_accepted_m_ = last_judged_m_ = path_m_;
  apply_matches(bearings);
}

std::string_view LampEkfEstimator::why_lost() const {
  if (relocaliser_.is_ambiguous()) return "several places on the map look alike";
  return "none of the landmarks is where it should be";
}

}  // namespace azimuth
