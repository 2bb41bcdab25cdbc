// Measures how often a comparison of twenty runs finds the one run that got worse, and how often it names another run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

#include "tests/tools/compare/made_reports.hpp"

namespace azimuth {
namespace {

constexpr int kRuns = 20;

/// Twenty runs with different errors. Each has several seeds, whose errors scatter by the relative deviation `scatter`.
class Corpus {
 public:
  Corpus(unsigned draw, double scatter, int seeds) : noise_(draw), scatter_(scatter), seeds_(seeds) {}

  /// One version of the corpus with seeds from `first_seed` on. The error of the run `worse` is multiplied by `factor`.
  Reports version(std::uint64_t first_seed, int worse = -1, double factor = 1.0) {
    Reports reports;
    for (int run = 0; run < kRuns; ++run)
      for (int i = 0; i < seeds_; ++i)
        reports.all.push_back(one(run, first_seed + static_cast<std::uint64_t>(i), run == worse ? factor : 1.0));
    return reports;
  }

 private:
  RunReport one(int run, std::uint64_t seed, double factor) {
    const double size = factor * std::exp(scatter_ * normal_(noise_));
    const double of_run = 0.05 * (1.0 + 0.2 * run);
    return test::made_report("run" + std::to_string(run),
                             {{"position_rmse_m", of_run * size},
                              {"heading_rmse_rad", 0.01 * std::exp(scatter_ * normal_(noise_))},
                              {"map_rmse_m", of_run * std::exp(scatter_ * normal_(noise_))},
                              {"anees", 3.0 * std::exp(2.0 * scatter_ * normal_(noise_))},
                              {"tracking_share", 0.97 - 0.2 * scatter_ * std::abs(normal_(noise_))}},
                             seed);
  }

  std::mt19937 noise_;
  std::normal_distribution<double> normal_;
  double scatter_;
  int seeds_;
};

bool names_alone(const Comparison& comparison, const std::string& name) {
  return test::names_with(comparison, Trend::worse) == std::vector<std::string>{name};
}

/// Equal versions with equal seeds give bit-identical figures.
TEST(Shows, OfTwentyPairsOfEqualVersionsNoneIsNamed) {
  for (unsigned draw = 0; draw < 20; ++draw) {
    const Reports version = Corpus(draw, 0.3, 1).version(1);
    const Comparison comparison = compare(version, &version, default_compare_settings());
    EXPECT_TRUE(test::names_with(comparison, Trend::worse).empty());
    EXPECT_TRUE(past_limits(comparison, default_compare_settings()).empty());
  }
}

TEST(Shows, OneRunInTwentyThatIsAFifthWorseIsFoundAndNamedAlone) {
  for (int worse = 0; worse < kRuns; ++worse) {
    const auto draw = static_cast<unsigned>(worse);
    const Reports before = Corpus(draw, 0.3, 1).version(1), after = Corpus(draw, 0.3, 1).version(1, worse, 1.2);
    const Comparison comparison = compare(after, &before, default_compare_settings());
    EXPECT_TRUE(names_alone(comparison, "run" + std::to_string(worse)));
    EXPECT_EQ(comparison.runs.front().name, "run" + std::to_string(worse)) << "what got worse comes first";
    EXPECT_EQ(past_limits(comparison, default_compare_settings()).size(), 1u);
  }
}

/// A comparison may raise a false alarm with a chance of 5 %.
TEST(Shows, EqualVersionsOfOtherSeedsAreHardlyEverNamed) {
  constexpr int kTrials = 400;
  for (const auto& [scatter, seeds] : {std::pair{0.03, 5}, {0.1, 5}, {0.3, 5}, {0.1, 3}, {0.3, 10}, {0.3, 1}}) {
    int alarms = 0;
    for (unsigned draw = 0; draw < kTrials; ++draw) {
      Corpus corpus(draw, scatter, seeds);
      const Reports before = corpus.version(1), after = corpus.version(100);
      const CompareSettings settings = default_compare_settings();
      alarms += past_limits(compare(after, &before, settings), settings).empty() ? 0 : 1;
    }
    std::printf("seeds scatter %.0f %%, %d of them: %d of %d comparisons of equal versions are alarms\n",
                100.0 * scatter, seeds, alarms, kTrials);
    EXPECT_LE(alarms, kTrials / 20);
  }
}

TEST(Shows, AFifthWorseIsFoundThroughTheScatterOfSeeds) {
  constexpr int kTrials = 200;
  for (const auto& [scatter, seeds, least] :
       {std::tuple{0.01, 3, 0.7}, {0.03, 5, 0.9}, {0.05, 10, 0.9}, {0.10, 10, 0.0}}) {
    int found = 0, others = 0;
    for (unsigned draw = 0; draw < kTrials; ++draw) {
      Corpus corpus(draw, scatter, seeds);
      const Reports before = corpus.version(1), after = corpus.version(100, 7, 1.2);
      const std::vector<std::string> worse =
          test::names_with(compare(after, &before, default_compare_settings()), Trend::worse);
      found += std::ranges::find(worse, "run7") != worse.end() ? 1 : 0;
      others += static_cast<int>(worse.size()) - (std::ranges::find(worse, "run7") != worse.end() ? 1 : 0);
    }
    std::printf("seeds scatter %.0f %%, %d of them: a fifth worse is found %d of %d times; %d others are named\n",
                100.0 * scatter, seeds, found, kTrials, others);
    EXPECT_GE(found, least * kTrials);
    EXPECT_LE(others, kTrials / 20);
  }
}

}  // namespace
}  // namespace azimuth
