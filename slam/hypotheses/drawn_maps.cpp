#include "slam/hypotheses/drawn_maps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr std::uint64_t kSeed = 15;

/// Mean and covariance of beliefs by weights that sum to one.
template <class BeliefOf>
Beam::PoseBelief mixture(std::span<const double> weights, BeliefOf belief_of) {
  const Pose2 centre = belief_of(0).T_map_body;
  const auto off_centre = [&](const Pose2& pose) -> Eigen::Vector3d {
    return {pose.x_m - centre.x_m, pose.y_m - centre.y_m, wrap(pose.heading_rad - centre.heading_rad)};
  };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i) mean += weights[i] * off_centre(belief_of(i).T_map_body);
  Beam::PoseBelief whole;
  whole.T_map_body = {centre.x_m + mean.x(), centre.y_m + mean.y(), wrap(centre.heading_rad + mean.z())};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Beam::PoseBelief belief = belief_of(i);
    const Eigen::Vector3d off = off_centre(belief.T_map_body) - mean;
    whole.covariance += weights[i] * (belief.covariance + off * off.transpose());
  }
  return whole;
}

/// Sum to one.
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
  population.belief = mixture(weights, [&](std::size_t i) -> Beam::PoseBelief {
    return {population.maps[i].pose(), population.maps[i].pose_covariance()};
  });
  const double of_squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  if (of_squares * static_cast<double>(weights.size()) > 2.0) resample(population);
}

/// Systematic: of weight w between floor(n w) and ceil(n w) copies.
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
  belief_ = mixture(alike, [&](std::size_t i) { return populations_[i].belief; });
}

}  // namespace azimuth
