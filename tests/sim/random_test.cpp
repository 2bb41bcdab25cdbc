#include "sim/world/random.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

TEST(Random, GivesTheSameBitsEverywhere) {
  // The values were computed independently from the definition of the stream. A change of the stream would change every
  // simulated run.
  Random random(1, RandomPurpose::scene);
  std::vector<double> drawn;
  for (int i = 0; i < 3; ++i) drawn.push_back(random.uniform());
  EXPECT_EQ(drawn, (std::vector<double>{0x1.c41664bccfccap-2, 0x1.5048b06e200cap-2, 0x1.7d2769b9059f3p-1}));
}

TEST(Random, PurposesAndSeedsAreDifferentStreams) {
  Random scene(1, RandomPurpose::scene), drive(1, RandomPurpose::drive), other(2, RandomPurpose::scene);
  const double first = scene.uniform();
  EXPECT_NE(first, drive.uniform());
  EXPECT_NE(first, other.uniform());
}

TEST(Random, UniformCoversItsRange) {
  Random random(3, RandomPurpose::scene);
  double sum = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double value = random.uniform(-2.0, 4.0);
    ASSERT_GE(value, -2.0);
    ASSERT_LT(value, 4.0);
    sum += value;
  }
  EXPECT_NEAR(sum / 100000, 1.0, 0.03);
}

TEST(Random, NormalHasTheMomentsOfAGaussian) {
  Random random(4, RandomPurpose::scene);
  constexpr int kCount = 200000;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal(2.0);
    sum += value;
    squares += value * value;
    fourths += std::pow(value, 4);
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(squares / kCount, 4.0, 0.06);
  EXPECT_NEAR(fourths / kCount, 3 * 16.0, 1.5);
}

TEST(Random, NeighbouringNormalsAreUncorrelated) {
  Random random(5, RandomPurpose::scene);
  constexpr int kCount = 100000;
  double product = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double first = random.normal(1.0);
    product += first * random.normal(1.0);
  }
  EXPECT_NEAR(product / kCount, 0.0, 0.015);
}

TEST(Random, PoissonHasEqualMeanAndVariance) {
  Random random(6, RandomPurpose::scene);
  constexpr int kCount = 100000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const int count = random.poisson(0.4);
    sum += count;
    squares += count * count;
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 0.4, 0.01);
  EXPECT_NEAR(squares / kCount - mean * mean, 0.4, 0.01);
  EXPECT_EQ(random.poisson(0.0), 0);
}

TEST(Random, IndexStaysBelowCount) {
  Random random(7, RandomPurpose::scene);
  std::vector<int> hits(5);
  for (int i = 0; i < 5000; ++i) ++hits.at(random.index(5));
  for (const int hit : hits) EXPECT_NEAR(hit, 1000, 150);
}

}  // namespace
}  // namespace azimuth
