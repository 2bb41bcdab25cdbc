#include "tools/page/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace azimuth {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Series = std::vector<std::vector<double>>;

Series random_series(std::mt19937_64& random, std::size_t count) {
  std::normal_distribution<double> normal;
  std::bernoulli_distribution is_missing(0.1), is_peak(0.001);
  Series series(3, std::vector<double>(count));
  for (std::vector<double>& values : series)
    for (double& value : values) value = is_missing(random) ? kNan : normal(random) * (is_peak(random) ? 1000.0 : 1.0);
  return series;
}

std::vector<std::size_t> thinned_of(const Series& series, std::size_t most) {
  const std::vector<std::span<const double>> spans(series.begin(), series.end());
  return thinned(series.front().size(), spans, most);
}

double greatest(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = from; i < to; ++i)
    if (std::isfinite(values[i])) most = std::max(most, values[i]);
  return most;
}

TEST(Thinning, KeepsEverythingThatFits) {
  EXPECT_EQ(thinned_of({{1.0, 2.0, 3.0}}, 4), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(thinned_of({{}}, 4).empty());
}

TEST(Thinning, StaysWithinItsBoundInOrderWithBothEnds) {
  std::mt19937_64 random(7);
  for (const std::size_t count : {9u, 100u, 1000u, 4321u, 40000u})
    for (const std::size_t most : {8u, 50u, 1001u}) {
      const std::vector<std::size_t> kept = thinned_of(random_series(random, count), most);
      EXPECT_LE(kept.size(), most);
      EXPECT_TRUE(std::ranges::is_sorted(kept));
      EXPECT_EQ(kept.front(), 0u);
      EXPECT_EQ(kept.back(), count - 1);
      EXPECT_EQ(std::ranges::adjacent_find(kept), kept.end());
    }
}

// The thinned series keeps the minimum and the maximum of every stretch, and therefore of the whole series.
TEST(Thinning, KeepsTheExtremesOfEverySeries) {
  std::mt19937_64 random(8);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Series series = random_series(random, 5000);
    const std::size_t most = 701, stretches = (most - 1) / 7;
    const std::vector<std::size_t> kept = thinned_of(series, most);
    for (std::vector<double> values : series)
      for (const double sign : {1.0, -1.0}) {
        for (double& value : values) value *= sign;
        std::vector<double> drawn(values.size(), kNan);
        for (const std::size_t i : kept) drawn[i] = values[i];
        for (std::size_t k = 0; k < stretches; ++k) {
          const std::size_t from = k * values.size() / stretches, to = (k + 1) * values.size() / stretches;
          EXPECT_EQ(greatest(drawn, from, to), greatest(values, from, to));
        }
      }
  }
}

}  // namespace
}  // namespace azimuth
