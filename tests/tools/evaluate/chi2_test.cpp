#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

// Expected values are from printed tables of the chi-squared distribution.
TEST(Chi2, GivesTheTablesValues) {
  EXPECT_NEAR(chi2_quantile(0.95, 1), 3.841458821, 1e-8);
  EXPECT_NEAR(chi2_quantile(0.025, 1), 0.000982069, 1e-9);
  EXPECT_NEAR(chi2_quantile(0.95, 2), -2.0 * std::log(0.05), 1e-8);
  EXPECT_NEAR(chi2_quantile(0.975, 3), 9.348403604, 1e-8);
  EXPECT_NEAR(chi2_quantile(0.025, 3), 0.215795283, 1e-8);
  EXPECT_NEAR(chi2_quantile(0.5, 10), 9.341817766, 1e-8);
  EXPECT_NEAR(chi2_quantile(0.99, 100), 135.806723, 1e-5);
}

TEST(Chi2, HoldsItsShareOfSamples) {
  std::mt19937_64 random(3);
  for (const std::size_t freedom : {1u, 4u, 25u, 400u}) {
    std::chi_squared_distribution<double> chi2(static_cast<double>(freedom));
    const double low = chi2_quantile(0.025, freedom), high = chi2_quantile(0.975, freedom);
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const double value = chi2(random);
      inside += value > low && value < high ? 1 : 0;
    }
    EXPECT_NEAR(inside / 20000.0, 0.95, 0.006) << freedom;
  }
}

}  // namespace
}  // namespace azimuth
