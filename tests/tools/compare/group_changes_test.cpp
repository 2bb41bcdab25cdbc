#include <cmath>
#include <gtest/gtest.h>

#include "tests/tools/compare/made_reports.hpp"

namespace azimuth {
namespace {

using test::figure;
using test::made_report;

const CompareSettings kAsShipped = default_compare_settings();
constexpr double kBefore_m = 0.1;

/// Compares runs whose error has grown by the given factors. Runs with an even index have the tag "even".
Comparison grown(const std::vector<double>& factors) {
  Reports now, then;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const std::vector<std::string> tags = i % 2 == 0 ? std::vector<std::string>{"even"} : std::vector<std::string>{};
    const std::string name = "run" + std::to_string(i);
    now.all.push_back(made_report(name, {{"position_rmse_m", kBefore_m * factors[i]}}, 1, tags));
    then.all.push_back(made_report(name, {{"position_rmse_m", kBefore_m}}, 1, tags));
  }
  return compare(now, &then, kAsShipped);
}

TEST(Groups, AreAllRunsAndThoseOfEachTag) {
  const Comparison comparison = grown({1.0, 1.1, 1.0, 1.2, 1.0});
  ASSERT_EQ(comparison.groups.size(), 2u);
  EXPECT_EQ(comparison.groups[0].tag, "");
  EXPECT_EQ(comparison.groups[0].runs, 5u);
  EXPECT_EQ(comparison.groups[1].tag, "even");
  EXPECT_EQ(comparison.groups[1].runs, 3u);
  EXPECT_EQ(comparison.groups[1].means[0].change.mean, 0.0);
}

/// An error that doubles and one that halves average to no change.
TEST(Groups, AverageRatiosByTheirLogarithms) {
  const ComparedGroup::Mean mean = grown({2.0, 0.5}).groups[0].means[0];
  EXPECT_NEAR(mean.change.mean, 0.0, 1e-12);
  EXPECT_NEAR(mean.change.low, -0.5, 1e-12);
  EXPECT_NEAR(mean.change.high, 1.0, 1e-12);
  EXPECT_NEAR(mean.before, kBefore_m, 1e-12);
  EXPECT_NEAR(mean.after, 1.25 * kBefore_m, 1e-12);
}

TEST(Groups, OfFewRunsAreNotJudged) {
  EXPECT_EQ(grown({1.3, 1.3, 1.31, 1.32, 1.3}).groups[0].means[0].trend, Trend::unmeasured);
  EXPECT_EQ(grown({1.3, 1.3, 1.31, 1.32, 1.3, 1.29}).groups[0].means[0].trend, Trend::worse);
}

TEST(Groups, ATwentiethMoreEverywhereIsWorseThoughNoRunIs) {
  std::vector<double> factors;
  for (int i = 0; i < 20; ++i) factors.push_back(1.05 + 0.01 * (i % 3));
  const Comparison comparison = grown(factors);
  EXPECT_TRUE(test::names_with(comparison, Trend::worse).empty());
  EXPECT_EQ(comparison.groups[0].means[0].trend, Trend::worse);
  EXPECT_GT(comparison.groups[0].means[0].change.low, 0.05);
  const std::vector<std::string> past = past_limits(comparison, kAsShipped);
  ASSERT_EQ(past.size(), 2u) << "all, and those with the tag";
  EXPECT_NE(past[0].find("all runs, on the average of 20 runs: position RMSE"), std::string::npos) << past[0];
}

TEST(Groups, OneThatGrewIsNoTrendOfAll) {
  std::vector<double> factors(20, 1.0);
  factors[7] = 1.5;
  EXPECT_EQ(grown(factors).groups[0].means[0].trend, Trend::alike);
  EXPECT_EQ(grown(std::vector<double>(20, 1.0)).groups[0].means[0].trend, Trend::equal);
}

}  // namespace
}  // namespace azimuth
