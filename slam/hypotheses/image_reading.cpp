#include "slam/hypotheses/image_reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace azimuth {
namespace {

// Number of standard deviations of the azimuth within the field of view for a landmark that is certainly in view.
constexpr double kCertainSigmas = 2.0;

}  // namespace

ImageReading::ImageReading(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
                           const ConditionedAssociationSettings& settings)
    : belief_(std::move(belief)),
      sightings_(sightings),
      settings_(&settings),
      log_detection_(std::log(settings.scene.detection_probability)),
      landmark_of_(sightings.size(), kOpen),
      taken_(belief_.landmarks.size(), 0) {}

void ImageReading::predict() {
  predictions_.resize(landmarks());
  for (std::size_t j = 0; j < landmarks(); ++j) {
    Prediction& prediction = predictions_[j];
    const SmoothedLandmark& landmark = belief_.landmarks[j];
    prediction.possible = taken_[j] == 0;
    if (!prediction.possible) continue;
    prediction.distance_m = landmark.is_point() ? (landmark.p_map() - belief_.pose.T_map_body.position()).norm()
                                                : std::numeric_limits<double>::infinity();
    prediction.possible = (!landmark.is_point() || prediction.distance_m < settings_->scene.asked_within_m()) &&
                          see(belief_.pose, landmark, settings_->min_distance_m, prediction.seen);
    if (!prediction.possible) continue;
    const auto column = static_cast<Eigen::Index>(3 + 2 * j);
    prediction.PH = belief_.covariance.leftCols<3>() * prediction.seen.by_pose +
                    belief_.covariance.middleCols<2>(column) * prediction.seen.by_landmark;
    prediction.variance = prediction.seen.by_pose.dot(prediction.PH.head<3>()) +
                          prediction.seen.by_landmark.dot(prediction.PH.segment<2>(column));
  }
  scores_.resize(bearings() * landmarks());
  for (std::size_t i = 0; i < bearings(); ++i)
    for (std::size_t j = 0; j < landmarks(); ++j) scores_[i * landmarks() + j] = score_of(i, j);
}

double ImageReading::score_of(std::size_t bearing, std::size_t landmark) const {
  const Prediction& prediction = predictions_[landmark];
  if (!prediction.possible || !is_open(bearing)) return kNever;
  const NamelessSighting& sighting = sightings_[bearing];
  if (!belief_.kinds.empty() && !same_kind(sighting.kind, belief_.kinds[landmark])) return kNever;
  const double S = prediction.variance + sighting.sigma_rad * sighting.sigma_rad;
  const double off = wrap(sighting.azimuth_rad - prediction.seen.azimuth_rad);
  if (!(off * off < settings_->gate_chi2 * S)) return kNever;
  return log_detection_ + log_normal_density(off, S);
}

int ImageReading::missed() const {
  return static_cast<int>(std::count_if(predictions_.begin(), predictions_.end(),
                                        [this](const Prediction& prediction) { return should_be_seen(prediction); }));
}

bool ImageReading::should_be_seen(const Prediction& prediction) const {
  const Scene& scene = settings_->scene;
  if (!prediction.possible || prediction.distance_m > scene.surely_seen_within_m()) return false;
  if (scene.sees_all_round()) return true;
  const double off_rad = std::abs(wrap(prediction.seen.azimuth_rad));
  return off_rad + kCertainSigmas * std::sqrt(prediction.variance) < 0.5 * scene.field_of_view_rad;
}

void ImageReading::take(std::size_t bearing, std::size_t landmark) {
  landmark_of_[bearing] = static_cast<int>(landmark);
  taken_[landmark] = 1;
  const Prediction& prediction = predictions_[landmark];
  const NamelessSighting& sighting = sightings_[bearing];
  const double S = prediction.variance + sighting.sigma_rad * sighting.sigma_rad;
  const Eigen::VectorXd step = prediction.PH * (wrap(sighting.azimuth_rad - prediction.seen.azimuth_rad) / S);
  belief_.covariance.noalias() -= prediction.PH * prediction.PH.transpose() / S;
  belief_.pose = belief_.pose.moved(step.head<3>());
  for (std::size_t j = 0; j < landmarks(); ++j)
    belief_.landmarks[j] = belief_.landmarks[j].moved(step.segment<2>(static_cast<Eigen::Index>(3 + 2 * j)));
}

std::vector<int> ImageReading::landmark_of() const {
  std::vector<int> landmark_of = landmark_of_;
  std::replace(landmark_of.begin(), landmark_of.end(), kOpen, kNothing);
  return landmark_of;
}

}  // namespace azimuth
