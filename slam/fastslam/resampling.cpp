#include "slam/fastslam/resampling.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

double normalise(std::span<const double> log_weights, std::span<double> weights) {
  const double largest = *std::ranges::max_element(log_weights);
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] = std::exp(log_weights[k] - largest);
  for (double& weight : weights) {
    weight /= sum;
    squares += weight * weight;
  }
  return 1.0 / squares;
}

void low_variance(std::span<const double> weights, double start, std::span<std::size_t> source) {
  double cumulative = weights[0];
  std::size_t particle = 0;
  for (std::size_t m = 0; m < source.size(); ++m) {
    const double at = start + static_cast<double>(m) / static_cast<double>(source.size());
    while (at > cumulative && particle + 1 < weights.size()) cumulative += weights[++particle];
    source[m] = particle;
  }
}

}  // namespace azimuth
