#include <gtest/gtest.h>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

TEST(Growth, FindsWhatStandsThere) {
  std::vector<int> names;
  NamelessWorld world(ring_of_landmarks());
  const Hypothesis hypothesis = driven(world, 20, &names);
  EXPECT_GE(hypothesis.landmarks().size(), 6U);
  EXPECT_LE(hypothesis.landmarks().size(), 10U);
  int right = 0, wrong = 0;
  for (const LandmarkId id : hypothesis.landmarks()) {
    std::vector<int> counts(9, 0);
    for (const BearingId bearing : hypothesis.graph().bearings_of(id))
      ++counts[static_cast<std::size_t>(names[static_cast<std::size_t>(bearing)])];
    const int most = *std::max_element(counts.begin(), counts.end());
    right += most;
    wrong += static_cast<int>(hypothesis.graph().bearings_of(id).size()) - most;
  }
  EXPECT_GT(right, 60);
  EXPECT_LT(10 * wrong, right);
}

TEST(Growth, OneLandmarkAloneIsFoundFromItsFourthSightingOn) {
  NamelessWorld world({{2.0, 2.2}});
  EXPECT_TRUE(driven(world, 3).landmarks().empty());
  NamelessWorld again({{2.0, 2.2}});
  EXPECT_EQ(driven(again, 9).landmarks().size(), 1U);
}

TEST(Growth, MakesNothingOfClutter) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    NamelessWorld world({}, seed);
    Hypothesis hypothesis(world_settings(), {});
    const auto clutter = [&] { return std::vector{NamelessSighting{world.uniform(), kSigma_rad}}; };
    hypothesis.begin(clutter());
    for (int i = 1; i < 25; ++i) hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), clutter());
    found += hypothesis.landmarks().size();
  }
  EXPECT_LE(found, 1U);  // in 250 images
}

}  // namespace
}  // namespace azimuth
