#include "slam/hypotheses/conditioned_association.hpp"

#include <algorithm>
#include <cmath>

#include "slam/hypotheses/image_reading.hpp"
#include "slam/hypotheses/joint_association.hpp"

namespace azimuth {
namespace {

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

}  // namespace

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

}  // namespace azimuth
