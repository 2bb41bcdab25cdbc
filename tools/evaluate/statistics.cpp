#include "tools/evaluate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace azimuth {

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

}  // namespace azimuth
