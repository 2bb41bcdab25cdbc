// LampEkfEstimator: what is a lamp and what a reflection, and what either may tell.

#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"

namespace azimuth {

/// Of what may be no lamp (docs/mathematics.md, VI.14), by what was predicted before anything is learnt from the image.
/// Only after some driving: from one place a reflection is as steady as a lamp.
void LampEkfEstimator::weigh_evidence() {
  if (crowded_ || doubts_ > 0 || lights_ == 0 || path_m_ - last_weighed_m_ < settings_.judge_every_m) return;
  last_weighed_m_ = path_m_;
  const double log_reflection = Reflections(lights_ + 1, max_zenith_rad_).log_per_sr();
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (matches_[i].fate != DirectionFate::paired) continue;
    const Predicted& predicted = paired(matches_[i]);
    Lamp& lamp = lamps_[predicted.lamp];
    lamp.last_weighed = image_;
    if (lamp.evidence.proven()) continue;
    // What is near may be a reflection, and the lamp missed.
    const double of_lamp = detection(predicted) * std::exp(ekf_.log_density({lamp.at, seen_[i]}) - log_reflection);
    lamp.evidence.seen(std::log(of_lamp + chance_of_miss(predicted)), 0.0);
  }
  for (const Predicted& predicted : predicted_)
    if (lamps_[predicted.lamp].last_weighed != image_)
      lamps_[predicted.lamp].evidence.missed(std::log(chance_of_miss(predicted)));
}

double LampEkfEstimator::chance_of_miss(const Predicted& predicted) const {
  return 1.0 - detection(predicted) * chance_of_view(predicted);
}

/// Of the lamp when it is in view. At the rim, where it may be cut, half of what is usual.
double LampEkfEstimator::detection(const Predicted& predicted) const {
  const bool at_rim = std::atan(predicted.offset.m.norm()) > max_zenith_rad_ * (1.0 - settings_.inner_margin);
  return (at_rim ? 0.5 : 1.0) * (1.0 - std::exp(log_missed_));
}

/// That it is not farther from the zenith than the camera sees.
double LampEkfEstimator::chance_of_view(const Predicted& predicted) const {
  const double length = predicted.offset.m.norm();
  if (!(length > 0.0)) return 1.0;
  const Eigen::Vector2d outwards = predicted.offset.m / (length * (1.0 + length * length));
  const double variance_rad2 = outwards.dot(predicted.covariance * outwards);
  return 0.5 * std::erfc((std::atan(length) - max_zenith_rad_) / std::sqrt(2.0 * variance_rad2 + 1e-12));
}

/// What may be no lamp tells nothing of the robot.
bool LampEkfEstimator::correct() {
  accepted_.clear();
  doubtful_.clear();
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (matches_[i].fate != DirectionFate::paired) continue;
    const Lamp& lamp = lamps_[paired(matches_[i]).lamp];
    (lamp.evidence.proven() ? accepted_ : doubtful_).push_back({lamp.at, seen_[i]});
  }
  if (!ekf_.update(accepted_)) return false;
  for (const MappedLampSighting& sighting : doubtful_) ekf_.update_lamp(sighting);
  return true;
}

}  // namespace azimuth
