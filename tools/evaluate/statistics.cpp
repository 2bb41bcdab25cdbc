#include "tools/evaluate/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace azimuth {
namespace {

/// The regularised incomplete gamma function P(n / 2, x / 2). The recursion P(a + 1, y) = P(a, y) - y^a exp(-y) /
/// Gamma(a + 1) starts from P(1/2, y) = erf(sqrt(y)) or P(1, y) = 1 - exp(-y).
double chi2_probability(double x, std::size_t freedom) {
  const double y = 0.5 * x, end = 0.5 * static_cast<double>(freedom);
  double a = freedom % 2 == 1 ? 0.5 : 1.0;
  double probability = freedom % 2 == 1 ? std::erf(std::sqrt(y)) : -std::expm1(-y);
  for (; a < end; a += 1.0) probability -= std::exp(a * std::log(y) - y - std::lgamma(a + 1.0));
  return probability;
}

}  // namespace

ErrorStatistics error_statistics(std::span<const double> errors) {
  if (errors.empty()) return {};
  double sum = 0.0, squares = 0.0;
  for (const double error : errors) {
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(errors.size());
  return {errors.size(), std::sqrt(squares / count), sum / count, *std::max_element(errors.begin(), errors.end()),
          errors.back()};
}

TimeStatistics time_statistics(std::span<const double> durations_us) {
  if (durations_us.empty()) return {};
  std::vector<double> sorted(durations_us.begin(), durations_us.end());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
  };
  const double sum_us = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  return {at(0.5), at(0.99), sorted.back(), sum_us / static_cast<double>(sorted.size())};
}

double chi2_quantile(double probability, std::size_t freedom) {
  assert(freedom > 0 && probability > 0.0 && probability < 1.0);
  double low = 0.0, high = static_cast<double>(freedom);
  while (chi2_probability(high, freedom) < probability) high *= 2.0;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (chi2_probability(middle, freedom) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace azimuth
