#include "slam/hypotheses/drawn_maps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr std::uint64_t kSeed = 15;

/// Weights that sum to one.
std::vector<double> weights_of(std::span<const double> log_weights) {
  const double most = *std::ranges::max_element(log_weights);
  std::vector<double> weights;
  for (const double log_weight : log_weights) weights.push_back(std::exp(log_weight - most));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

DrawnMaps::DrawnMaps(const DrawnMapsSettings& settings) : settings_(settings) {
  const std::size_t members = as_size(settings.members);
  for (int i = 0; i < settings.populations; ++i)
    populations_.push_back({Draws(Xoshiro(mixed_bits(kSeed + static_cast<std::uint64_t>(i)))),
                            std::vector<DrawnMap>(members), std::vector<double>(members, 0.0)});
}

void DrawnMaps::begin(std::span<const NamelessSighting> sightings, Workers& workers) {
  take(sightings, workers, nullptr);
}

void DrawnMaps::add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers,
                          double after_s) {
  now_s_ += after_s;
  take(sightings, workers, &motion);
}

void DrawnMaps::take(std::span<const NamelessSighting> sightings, Workers& workers, const Motion* motion) {
  workers.for_each(populations_.size(), [&](std::size_t p) {
    Population& population = populations_[p];
    for (std::size_t i = 0; i < population.maps.size(); ++i) {
      DrawnMap& map = population.maps[i];
      if (motion != nullptr) map.move(*motion);
      population.log_weights[i] += map.take(sightings, settings_.map, now_s_, population.draws);
    }
    weigh(population);
  });
  conclude();
}

void DrawnMaps::weigh(Population& population) {
  const std::vector<double> weights = weights_of(population.log_weights);
  std::vector<BelievedPose> beliefs;
  for (const DrawnMap& map : population.maps) beliefs.push_back({map.pose(), map.pose_covariance()});
  population.belief = mixture(beliefs, weights, beliefs.front().T_map_body);
  const double of_squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  if (of_squares * static_cast<double>(weights.size()) > 2.0) resample(population);
}

/// Systematic resampling: a map of weight w gets floor(n w) or ceil(n w) copies.
void DrawnMaps::resample(Population& population) {
  const std::vector<double> weights = weights_of(population.log_weights);
  const auto count = static_cast<double>(weights.size());
  double at = population.draws.uniform() / count, cumulated = weights[0];
  std::size_t from = 0;
  std::vector<DrawnMap> maps;
  for (std::size_t i = 0; i < weights.size(); ++i, at += 1.0 / count) {
    while (cumulated < at && from + 1 < weights.size()) cumulated += weights[++from];
    maps.push_back(population.maps[from]);
  }
  population.maps = std::move(maps);
  std::ranges::fill(population.log_weights, 0.0);
}

void DrawnMaps::conclude() {
  const std::vector<double> alike(populations_.size(), 1.0 / static_cast<double>(populations_.size()));
  std::vector<BelievedPose> beliefs;
  for (const Population& population : populations_) beliefs.push_back(population.belief);
  belief_ = mixture(beliefs, alike, beliefs.front().T_map_body);
}

}  // namespace azimuth
