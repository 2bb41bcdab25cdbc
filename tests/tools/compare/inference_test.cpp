#include "tools/compare/inference.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace azimuth {
namespace {

TEST(Spread, IsTheUnbiasedVariance) {
  const Spread all = spread(std::array{1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(all.mean, 3.0);
  EXPECT_DOUBLE_EQ(all.variance, (4.0 + 1.0 + 0.0 + 9.0) / 3.0);
  EXPECT_EQ(all.count, 4u);
  EXPECT_EQ(spread(std::array{5.0}).variance, 0.0);
  EXPECT_TRUE(std::isnan(spread({}).mean));
}

/// Expected values are from printed tables of Student's t distribution.
TEST(StudentTail, IsThatOfTheTables) {
  EXPECT_NEAR(student_tail(6.314, 1), 0.05, 1e-5);
  EXPECT_NEAR(student_tail(2.132, 4), 0.05, 2e-5);
  EXPECT_NEAR(student_tail(4.604, 4), 0.005, 1e-6);
  EXPECT_NEAR(student_tail(1.812, 10), 0.05, 5e-5);
  EXPECT_NEAR(student_tail(4.144, 10), 0.001, 1e-6);
  EXPECT_NEAR(student_tail(1.96, 1e9), 0.025, 5e-6);
  EXPECT_DOUBLE_EQ(student_tail(0.0, 3), 0.5);
  EXPECT_NEAR(student_tail(-2.132, 4), 0.95, 2e-5);
}

/// With one degree of freedom this is the Cauchy distribution, whose tail has a closed form.
TEST(StudentTail, IsRightFarOut) {
  for (const double t : {0.5, 3.0, 40.0, 1e4})
    EXPECT_NEAR(student_tail(t, 1) / (std::atan(1.0 / t) / M_PI), 1.0, 1e-9) << t;
}

TEST(ChanceOfRise, IsWelchsTest) {
  // Two samples of three values have means 1 and 2 and variances 0.01 and 0.04. Then t = 1 / sqrt(0.05 / 3) = 7.746 and
  // the degrees of freedom are (0.05 / 3)^2 / ((0.01 / 3)^2 / 2 + (0.04 / 3)^2 / 2) = 2.941.
  const Spread a = spread(std::array{0.9, 1.0, 1.1}), b = spread(std::array{1.8, 2.0, 2.2});
  EXPECT_NEAR(chance_of_rise(a, b), student_tail(7.745967, 2.941176), 1e-8);
  EXPECT_NEAR(chance_of_rise(b, a), 1.0 - chance_of_rise(a, b), 1e-12);
}

TEST(ChanceOfRise, TakesTheScatterOfTheOtherForOneThatStandsAlone) {
  const Spread a = spread(std::array{0.9, 1.0, 1.1}), b = spread(std::array{1.3});
  EXPECT_NEAR(chance_of_rise(a, b), student_tail(0.3 / std::sqrt(0.01 / 3 + 0.01), 2), 1e-9);
}

TEST(ChanceOfRise, KnowsWhatCannotBeTold) {
  const Spread one = spread(std::array{1.0}), two = spread(std::array{2.0});
  EXPECT_TRUE(std::isnan(chance_of_rise(one, two)));
  EXPECT_TRUE(std::isnan(chance_of_rise(spread({}), two)));
  const Spread same = spread(std::array{1.0, 1.0, 1.0}), more = spread(std::array{2.0, 2.0});
  EXPECT_EQ(chance_of_rise(same, more), 0.0);
  EXPECT_EQ(chance_of_rise(more, same), 1.0);
  EXPECT_EQ(chance_of_rise(same, same), 1.0);
}

TEST(Bootstrap, GivesTheSameBitsAgain) {
  const std::array values{0.1, -0.2, 0.4, 0.3, 0.0};
  const MeanInterval first = bootstrap_mean(values), again = bootstrap_mean(values);
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  EXPECT_NE(first.low, bootstrap_mean(values, 2).low);
  EXPECT_NEAR(first.mean, 0.12, 1e-12);
}

TEST(Bootstrap, HasNoIntervalOfOneValue) {
  EXPECT_TRUE(std::isnan(bootstrap_mean(std::array{0.3}).low));
  EXPECT_EQ(bootstrap_mean(std::array{0.3}).mean, 0.3);
  EXPECT_TRUE(std::isnan(bootstrap_mean({}).mean));
  EXPECT_EQ(bootstrap_mean(std::array{0.3, 0.3, 0.3}).low, 0.3);
}

/// A bootstrap sample of two values has one of them as mean in half of the cases, so the interval reaches from the one
/// value to the other.
TEST(Bootstrap, IsKnownOfTwoValues) {
  const MeanInterval interval = bootstrap_mean(std::array{1.0, 3.0});
  EXPECT_EQ(interval.low, 1.0);
  EXPECT_EQ(interval.high, 3.0);
}

/// The interval contains the true mean in about 95 % of cases for many values and less often for few values.
TEST(Bootstrap, HoldsTheTruthAsOftenAsItSays) {
  for (const auto& [count, least] : {std::pair{6, 0.85}, {20, 0.90}, {100, 0.92}}) {
    std::mt19937 noise(7);
    std::normal_distribution<double> normal(0.3, 1.0);
    int held = 0;
    constexpr int kTrials = 400;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> values(static_cast<std::size_t>(count));
      for (double& value : values) value = normal(noise);
      const MeanInterval interval = bootstrap_mean(values);
      held += interval.low <= 0.3 && 0.3 <= interval.high ? 1 : 0;
    }
    std::printf("of %d values: held %d of %d times\n", count, held, kTrials);
    EXPECT_GE(held, least * kTrials) << count;
    EXPECT_LE(held, 0.985 * kTrials) << count;
  }
}

}  // namespace
}  // namespace azimuth
