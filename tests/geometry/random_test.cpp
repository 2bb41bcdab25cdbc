#include "slam/geometry/random.hpp"

#include <gtest/gtest.h>
#include <random>
#include <set>
#include <vector>

namespace azimuth {
namespace {

/// The numbers equal those of the authors' programs. Maps, recordings and digests depend on these bits.
TEST(Random, GivesThePublishedWords) {
  SplitMix split(1234567);
  for (const std::uint64_t word :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U, 16408922859458223821U})
    EXPECT_EQ(split(), word);
  Xoshiro first(1), again(1), other(2);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t word = first();
    EXPECT_EQ(word, again());
    EXPECT_NE(word, other());
  }
}

TEST(Random, AnIndexIsBelowItsCountAndTakesEveryValue) {
  SplitMix bits(3);
  std::set<std::size_t> drawn;
  for (int i = 0; i < 200; ++i) drawn.insert(bits.index(7));
  EXPECT_EQ(drawn, (std::set<std::size_t>{0, 1, 2, 3, 4, 5, 6}));
}

template <class Bits>
void expect_moments(Bits bits) {
  constexpr int kMany = 200'000;
  RandomNumbers<Bits> random(bits);
  double sum = 0.0, squares = 0.0, fourths = 0.0, uniforms = 0.0;
  for (int i = 0; i < kMany; ++i) {
    const double x = random.normal(), u = random.uniform();
    ASSERT_TRUE(u >= 0.0 && u < 1.0);
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    uniforms += u;
  }
  EXPECT_NEAR(sum / kMany, 0.0, 0.01);
  EXPECT_NEAR(squares / kMany, 1.0, 0.02);
  EXPECT_NEAR(fourths / kMany, 3.0, 0.1);
  EXPECT_NEAR(uniforms / kMany, 0.5, 0.005);
}

TEST(Random, HasTheMomentsOfItsDistributions) {
  expect_moments(SplitMix(3));
  expect_moments(Xoshiro(3));
  expect_moments(std::mt19937_64(3));
}

TEST(Random, DrawsTheSameAmountWhateverSigmaIs) {
  RandomNumbers<Xoshiro> still(Xoshiro(5)), noisy(Xoshiro(5));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(still.normal(0.0), 0.0);
    noisy.normal(2.0);
  }
  EXPECT_EQ(still.uniform(), noisy.uniform());
}

}  // namespace
}  // namespace azimuth
