#include "slam/lost/lost_robot.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

namespace {

constexpr double kMostOfAnImage = 4.0;  // limit per image, since a common cause may spoil all its bearings
constexpr double kLeastShare = 0.3, kMostShare = 0.8;
constexpr double kLeastChance = 0.05, kMostChance = 0.6;
constexpr double kLearning = 0.05;
constexpr double kFading = 0.9;  // decay of the log odds when an image carries no evidence

}  // namespace

void AgreementWatch::add(const ImageAgreement& image) {
  if (image.log_odds) {
    if (image.expected == 0) log_odds_ *= kFading;
    log_odds_ = std::max(0.0, log_odds_ + *image.log_odds);
    return;
  }
  // Number of landmarks that could have been found again: a half-covered camera sees fewer.
  const int trials = std::min(image.expected, image.bearings);
  if (trials == 0 || image.chance > kMostChance) {
    log_odds_ *= kFading;
    return;
  }
  const double hits = std::min(trials, image.explained), misses = trials - hits;
  if (hits == 0.0 && misses == 1.0) {  // a single landmark may be occluded, for any length of time
    log_odds_ *= kFading;
    return;
  }
  const double chance = std::clamp(image.chance, kLeastChance, kMostChance);
  const double usual = std::clamp(usual_share_, std::max(kLeastShare, std::min(1.3 * chance, kMostShare)), kMostShare);
  const double said = hits * std::log(chance / usual) + misses * std::log((1.0 - chance) / (1.0 - usual));
  log_odds_ = std::max(0.0, log_odds_ + std::clamp(said, -kMostOfAnImage, kMostOfAnImage));
  if (!doubts()) usual_share_ += kLearning * (hits / trials - usual_share_);
}

namespace {

constexpr double kAnywhere_m = 100.0;
constexpr double kSlip_m = 1.0, kSlip_rad = 0.3;
constexpr double kLeastOfRivals = 0.1;  // probability

}  // namespace

Eigen::Matrix3d independent(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

Eigen::Matrix3d LostRobot::anywhere() { return independent(kAnywhere_m, kPi); }

void LostRobot::begin_search(std::span<const KnownLandmark> map, const CameraView& view,
                             const std::optional<PositionPrior>& within) {
  if (!relocaliser_) relocaliser_.emplace(settings_);
  relocaliser_->start(map, view, within);
  watch_.settle();
  searching_ = true;
}

void LostRobot::predict(const Motion& motion) {
  if (searching_) relocaliser_->predict(motion);
}

std::optional<PoseHypothesis> LostRobot::look(std::span<const SeenDirection> directions) {
  relocaliser_->update(directions);
  return relocaliser_->found();
}

std::optional<PoseHypothesis> LostRobot::nearby(const Pose2& T_map_body) const {
  if (!relocaliser_->is_ambiguous()) return std::nullopt;
  for (const PoseHypothesis& place : relocaliser_->hypotheses()) {
    const Pose2 off = inverse(T_map_body) * place.T_map_body;
    if (off.position().norm() > kSlip_m || std::abs(off.heading_rad) > kSlip_rad) continue;
    const bool proven = place.images >= settings_.found_images && place.driven_m >= settings_.found_distance_m &&
                        place.explained >= settings_.found_explained;
    if (proven && place.probability > kLeastOfRivals) return place;
  }
  return std::nullopt;
}

void LostRobot::was_found() {
  searching_ = false;
  watch_.settle();
}

std::optional<Judgement> LostRobot::judgement() const {
  if (searching_ && relocaliser_->is_ambiguous())
    return Judgement{Health::lost, "several places on the map look alike"};
  if (searching_) return Judgement{Health::lost, "none of the landmarks is where it should be"};
  if (watch_.doubts()) return Judgement{Health::degraded, "bearings contradict the map"};
  return std::nullopt;
}

}  // namespace azimuth
