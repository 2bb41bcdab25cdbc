#include "slam/hypotheses/conditioned_association.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace azimuth {
namespace {

// Number of standard deviations of the azimuth within the field of view for a landmark that is certainly in view.
constexpr double kCertainSigmas = 2.0;

struct ScoredPair {
  std::size_t bearing = 0, landmark = 0;
  double surplus = ImageReading::kNever;  // margin minus the required margin; kNever: no pair
};

/// Finds the pair with the largest surplus over the best rivals of its bearing and of its landmark.
ScoredPair clearest_pair(const ImageReading& reading, const ConditionedAssociationSettings& settings) {
  struct Two {
    double best = ImageReading::kNever, second = ImageReading::kNever;
    void add(double value) {
      second = std::max(second, std::min(best, value));
      best = std::max(best, value);
    }
    double rival(double value) const { return value >= best ? second : best; }
  };
  std::vector<Two> rows(reading.bearings()), columns(reading.landmarks());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      rows[i].add(reading.score(i, j));
      columns[j].add(reading.score(i, j));
    }
  ScoredPair best;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const double score = reading.score(i, j);
      if (score == ImageReading::kNever) continue;
      const double margin = score - std::max({rows[i].rival(score), columns[j].rival(score), settings.log_nothing()});
      const double surplus = margin - settings.margin_of(j);
      if (surplus > best.surplus) best = {i, j, surplus};
    }
  return best;
}

/// Whether a bearing is still undecided that could belong to a landmark.
bool leaves_open(const ImageReading& end, const ImageReading& start) {
  for (std::size_t i = 0; i < start.bearings(); ++i)
    for (std::size_t j = 0; j < start.landmarks(); ++j)
      if (end.is_open(i) && start.score(i, j) > ImageReading::kNever) return true;
  return false;
}

constexpr std::size_t kReadingsFollowed = 6;
// Readings and answers whose ln of the odds against the most likely one is larger than this are dropped.
constexpr double kFollowedWithin = 8.0;
// Lower bound of the probability of all other readings, since dropped readings have some probability.
constexpr double kLeastDoubt = 1e-12;

struct WeighedReading {
  ImageReading reading;
  double log_weight = 0.0;
};

/// One continuation of a reading: a bearing and its landmark, or -1.
struct Answer {
  std::size_t reading = 0, bearing = 0;
  int landmark = -1;
  double score = 0.0, log_at_most = 0.0;  // log_at_most: bound on the resulting reading's log weight
};

/// The joint association of one image, one bearing per round.
class JointRounds {
 public:
  JointRounds(const ImageReading& start, const ConditionedAssociationSettings& settings)
      : settings_(settings), nothing_(settings.log_nothing()), readings_{{start}} {}

  std::vector<int> run() {
    for (std::size_t round = 0; round < bearings(); ++round) {
      answers_.clear();
      for (std::size_t r = 0; r < readings_.size(); ++r) ask(r);
      follow_likeliest();
    }
    count_missed();
    return clear_pairs_of_all();
  }

 private:
  std::size_t bearings() const { return readings_.front().reading.bearings(); }
  std::size_t landmarks() const { return readings_.front().reading.landmarks(); }

  /// Picks the open bearing whose best answer has the largest margin, and lists its possible answers.
  void ask(std::size_t r) {
    ImageReading& reading = readings_[r].reading;
    reading.predict();
    std::size_t clearest = 0;
    double widest = ImageReading::kNever, clearest_best = 0.0, log_at_most = readings_[r].log_weight;
    for (std::size_t i = 0; i < bearings(); ++i) {
      if (!reading.is_open(i)) continue;
      const auto [best, margin] = best_answer(reading, i);
      log_at_most += best;
      if (margin > widest) {
        widest = margin;
        clearest = i;
        clearest_best = best;
      }
    }
    const double least = clearest_best - kFollowedWithin, log_others = log_at_most - clearest_best;
    bool is_nothing_likely = nothing_ >= least;
    for (std::size_t j = 0; j < landmarks(); ++j) {
      const double score = reading.score(clearest, j);
      if (score < least) continue;
      answers_.push_back({r, clearest, static_cast<int>(j), score, log_others + score});
      is_nothing_likely = is_nothing_likely || best_of_others(reading, clearest, j) > score - kFollowedWithin;
    }
    if (is_nothing_likely) answers_.push_back({r, clearest, -1, nothing_, log_others + nothing_});
  }

  struct Best {
    double score, margin;  // margin over the bearing's other answers and over other bearings of the same landmark
  };
  Best best_answer(const ImageReading& reading, std::size_t bearing) const {
    double best = nothing_, second = ImageReading::kNever;
    int landmark = -1;
    for (std::size_t j = 0; j < landmarks(); ++j) {
      const double score = reading.score(bearing, j);
      if (score > best) {
        second = best;
        best = score;
        landmark = static_cast<int>(j);
      } else {
        second = std::max(second, score);
      }
    }
    if (landmark >= 0) second = std::max(second, best_of_others(reading, bearing, static_cast<std::size_t>(landmark)));
    return {best, best - second};
  }

  double best_of_others(const ImageReading& reading, std::size_t bearing, std::size_t landmark) const {
    double best = ImageReading::kNever;
    for (std::size_t i = 0; i < bearings(); ++i)
      if (i != bearing) best = std::max(best, reading.score(i, landmark));
    return best;
  }

  void follow_likeliest() {
    std::stable_sort(answers_.begin(), answers_.end(),
                     [](const Answer& a, const Answer& b) { return a.log_at_most > b.log_at_most; });
    if (answers_.size() > kReadingsFollowed) answers_.resize(kReadingsFollowed);
    const double least = answers_.front().log_at_most - kFollowedWithin;
    std::erase_if(answers_, [&](const Answer& answer) { return answer.log_at_most < least; });
    std::vector<WeighedReading> followed;
    followed.reserve(answers_.size());
    for (const Answer& answer : answers_) {
      WeighedReading& next = followed.emplace_back(readings_[answer.reading]);
      next.log_weight += answer.score;
      if (answer.landmark >= 0)
        next.reading.take(answer.bearing, static_cast<std::size_t>(answer.landmark));
      else
        next.reading.leave(answer.bearing);
    }
    readings_ = std::move(followed);
  }

  void count_missed() {
    const double log_miss = std::log1p(-settings_.scene.detection_probability);
    for (WeighedReading& weighed : readings_) {
      weighed.reading.predict();
      weighed.log_weight += log_miss * weighed.reading.missed();
    }
  }

  /// The pairs that are clear in the weighted sum of all readings.
  std::vector<int> clear_pairs_of_all() const {
    double most = ImageReading::kNever, sum = 0.0;
    for (const WeighedReading& weighed : readings_) most = std::max(most, weighed.log_weight);
    std::vector<double> weight_of_pair(bearings() * landmarks(), 0.0);
    for (const WeighedReading& weighed : readings_) {
      const double weight = std::exp(weighed.log_weight - most);
      sum += weight;
      const std::vector<int> landmark_of = weighed.reading.landmark_of();
      for (std::size_t i = 0; i < bearings(); ++i)
        if (landmark_of[i] >= 0) weight_of_pair[i * landmarks() + static_cast<std::size_t>(landmark_of[i])] += weight;
    }
    std::vector<int> clear(bearings(), -1);
    for (std::size_t i = 0; i < bearings(); ++i)
      for (std::size_t j = 0; j < landmarks(); ++j) {
        const double p = weight_of_pair[i * landmarks() + j] / sum;
        if (p > 0.5 && std::log(p / std::max(1.0 - p, kLeastDoubt)) >= settings_.margin_of(j))
          clear[i] = static_cast<int>(j);
      }
    return clear;
  }

  const ConditionedAssociationSettings& settings_;
  const double nothing_;
  std::vector<WeighedReading> readings_;
  std::vector<Answer> answers_;
};

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

std::vector<int> associate_conditioned(PoseAndLandmarks belief, std::span<const NamelessSighting> sightings,
                                       const ConditionedAssociationSettings& settings) {
  ImageReading start(std::move(belief), sightings, settings);
  start.predict();
  ImageReading reading = start;
  ScoredPair best = clearest_pair(reading, settings);
  while (best.surplus >= 0.0) {
    reading.take(best.bearing, best.landmark);
    reading.predict();
    best = clearest_pair(reading, settings);
  }
  return settings.reads_whole && leaves_open(reading, start) ? associate_jointly(start, settings)
                                                             : reading.landmark_of();
}

std::vector<int> associate_jointly(const ImageReading& start, const ConditionedAssociationSettings& settings) {
  return JointRounds(start, settings).run();
}

}  // namespace azimuth
