#include "slam/hypotheses/conditioned_association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace azimuth {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// The rounds of one image.
class Rounds {
 public:
  Rounds(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
         const ConditionedAssociationSettings& settings)
      : belief_(std::move(belief)),
        sightings_(sightings),
        settings_(settings),
        landmark_of_(sightings.size(), -1),
        taken_(belief_.landmarks.size(), 0) {}

  std::vector<int> run() {
    for (;;) {
      predict();
      const Pair best = clearest();
      if (!(best.surplus >= 0.0)) return landmark_of_;
      landmark_of_[best.bearing] = static_cast<int>(best.landmark);
      taken_[best.landmark] = 1;
      condition(best);
    }
  }

 private:
  struct Prediction {
    SeenAzimuth seen;
    Eigen::VectorXd PH;  // covariance with everything
    double variance = 0.0;
    bool possible = false;
  };
  struct Pair {
    std::size_t bearing = 0, landmark = 0;
    double surplus = kNever;  // of the margin over that which is asked for
  };

  void predict() {
    predictions_.resize(belief_.landmarks.size());
    for (std::size_t j = 0; j < predictions_.size(); ++j) {
      Prediction& prediction = predictions_[j];
      prediction.possible = taken_[j] == 0 && is_near(belief_.landmarks[j]) &&
                            see(belief_.pose, belief_.landmarks[j], settings_.min_distance_m, prediction.seen);
      if (!prediction.possible) continue;
      const auto column = static_cast<Eigen::Index>(3 + 2 * j);
      prediction.PH = belief_.covariance.leftCols<3>() * prediction.seen.by_pose +
                      belief_.covariance.middleCols<2>(column) * prediction.seen.by_landmark;
      prediction.variance = prediction.seen.by_pose.dot(prediction.PH.head<3>()) +
                            prediction.seen.by_landmark.dot(prediction.PH.segment<2>(column));
    }
  }

  bool is_near(const SmoothedLandmark& landmark) const {
    if (!landmark.is_point()) return true;
    const Eigen::Vector2d away = landmark.p_map() - belief_.pose.T_map_body.position();
    return away.squaredNorm() < settings_.max_distance_m * settings_.max_distance_m;
  }

  double score(std::size_t bearing, std::size_t landmark) const {
    const Prediction& prediction = predictions_[landmark];
    if (!prediction.possible || landmark_of_[bearing] >= 0) return kNever;
    const NamelessSighting& sighting = sightings_[bearing];
    if (!belief_.kinds.empty() && !same_kind(sighting.kind, belief_.kinds[landmark])) return kNever;
    const double S = prediction.variance + sighting.sigma_rad * sighting.sigma_rad;
    const double off = wrap(sighting.azimuth_rad - prediction.seen.azimuth_rad);
    if (!(off * off < settings_.gate_chi2 * S)) return kNever;
    return settings_.log_detection + log_normal_density(off, S);
  }

  /// Best and second best of each row and column, then the pair that is furthest ahead of both.
  Pair clearest() {
    struct Two {
      double best = kNever, second = kNever;
      void add(double value) {
        second = std::max(second, std::min(best, value));
        best = std::max(best, value);
      }
      double rival(double value) const { return value >= best ? second : best; }
    };
    std::vector<Two> rows(sightings_.size()), columns(predictions_.size());
    scores_.resize(rows.size() * columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const double value = scores_[i * columns.size() + j] = score(i, j);
        rows[i].add(value);
        columns[j].add(value);
      }
    Pair best;
    const double nothing = settings_.log_unexplained - settings_.new_landmark_bonus;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const double value = scores_[i * columns.size() + j];
        if (value == kNever) continue;
        const double margin = value - std::max({rows[i].rival(value), columns[j].rival(value), nothing});
        const double surplus = margin - (settings_.margins.empty() ? settings_.min_margin : settings_.margins[j]);
        if (surplus > best.surplus) best = {i, j, surplus};
      }
    return best;
  }

  void condition(const Pair& pair) {
    const Prediction& prediction = predictions_[pair.landmark];
    const NamelessSighting& sighting = sightings_[pair.bearing];
    const double S = prediction.variance + sighting.sigma_rad * sighting.sigma_rad;
    const Eigen::VectorXd step = prediction.PH * (wrap(sighting.azimuth_rad - prediction.seen.azimuth_rad) / S);
    belief_.covariance.noalias() -= prediction.PH * prediction.PH.transpose() / S;
    belief_.pose = belief_.pose.moved(step.head<3>());
    for (std::size_t j = 0; j < belief_.landmarks.size(); ++j)
      belief_.landmarks[j] = belief_.landmarks[j].moved(step.segment<2>(static_cast<Eigen::Index>(3 + 2 * j)));
  }

  PoseAndLandmarks belief_;
  std::span<const NamelessSighting> sightings_;
  const ConditionedAssociationSettings& settings_;
  std::vector<int> landmark_of_;
  std::vector<char> taken_;
  std::vector<Prediction> predictions_;
  std::vector<double> scores_;
};

}  // namespace

std::vector<int> associate_conditioned(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
                                       const ConditionedAssociationSettings& settings) {
  return Rounds(std::move(belief), sightings, settings).run();
}

}  // namespace azimuth
