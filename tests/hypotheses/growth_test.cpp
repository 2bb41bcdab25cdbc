#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

struct Explained {
  // A bearing is right if it belongs to the same true landmark as most bearings of its mapped landmark.
  int right = 0, wrong = 0;
};

Explained explained(const Hypothesis& hypothesis, const std::vector<int>& names) {
  Explained result;
  for (const LandmarkId id : hypothesis.landmarks()) {
    std::map<int, int> counts;
    int most = 0;
    for (const BearingId bearing : hypothesis.graph().bearings_of(id))
      most = std::max(most, ++counts[names[static_cast<std::size_t>(bearing)]]);
    result.right += most;
    result.wrong += static_cast<int>(hypothesis.graph().bearings_of(id).size()) - most;
  }
  return result;
}

TEST(Growth, FindsWhatStandsThere) {
  std::vector<int> names;
  NamelessWorld world(ring_of_landmarks());
  const Hypothesis hypothesis = driven(world, 20, &names);
  EXPECT_GE(hypothesis.landmarks().size(), 6U);
  EXPECT_LE(hypothesis.landmarks().size(), 10U);
  const Explained bearings = explained(hypothesis, names);
  EXPECT_GT(bearings.right, 60);
  EXPECT_LT(10 * bearings.wrong, bearings.right);
}

// Each image has as many clutter bearings as an image in which a crowd of landmarks is initialised together.
TEST(Growth, MakesLittleOfACrowdOfClutter) {
  std::size_t explained = 0, bearings = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    NamelessWorld world({}, seed, 0.05);
    Hypothesis hypothesis(world_settings(), {});
    const auto clutter = [&] {
      std::vector<NamelessSighting> image;
      for (int i = 0; i < 20; ++i) image.push_back({world.uniform(), kSigma_rad});
      return image;
    };
    hypothesis.begin(clutter());
    for (int i = 1; i < 25; ++i) hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), clutter());
    for (const LandmarkId id : hypothesis.landmarks()) explained += hypothesis.graph().bearings_of(id).size();
    bearings += static_cast<std::size_t>(hypothesis.graph().bearings());
  }
  EXPECT_LT(6 * explained, bearings);
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
  EXPECT_LE(found, 1U);  // out of 250 images
}

}  // namespace
}  // namespace azimuth
