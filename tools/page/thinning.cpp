#include "tools/page/thinning.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

namespace azimuth {
namespace {

/// Adds the indices of the minimum and the maximum of a stretch, if it has finite values.
void add_extremes(std::span<const double> values, std::size_t from, std::size_t to, std::vector<std::size_t>& kept) {
  std::optional<std::size_t> least, greatest;
  for (std::size_t i = from; i < to; ++i) {
    if (!std::isfinite(values[i])) continue;
    if (!least || values[i] < values[*least]) least = i;
    if (!greatest || values[i] > values[*greatest]) greatest = i;
  }
  if (least) kept.insert(kept.end(), {*least, *greatest});
}

}  // namespace

std::vector<std::size_t> thinned(std::size_t count, std::span<const std::span<const double>> series, std::size_t most) {
  assert(most >= 2 * (1 + series.size()));
  std::vector<std::size_t> kept;
  if (count <= most) {
    kept.resize(count);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const std::size_t stretches = (most - 1) / (1 + 2 * series.size());
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t from = k * count / stretches, to = (k + 1) * count / stretches;
    kept.push_back(from);
    for (const std::span<const double> values : series) add_extremes(values, from, to, kept);
  }
  kept.push_back(count - 1);
  std::ranges::sort(kept);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace azimuth
