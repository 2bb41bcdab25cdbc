#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

struct Explained {
  int right = 0, wrong = 0;  // bearings, by what most of their landmark's are of
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

/// All round the circle, but not where the robot drives; each image shows some 20 of them.
std::vector<Eigen::Vector2d> crowd_of_landmarks() {
  std::vector<Eigen::Vector2d> crowd;
  for (int i = 0; i < 50; ++i) {
    const double at = 2.399963 * i, away_m = 8.0 * std::sqrt(i / 50.0);  // a sunflower's seeds
    if (std::abs(away_m - 4.0) > 0.6) crowd.emplace_back(away_m * std::cos(at), away_m * std::sin(at));
  }
  return crowd;
}

// Odometry that turns by 3 degrees an image: no landmark of such a crowd stands against chance by itself.
TEST(Growth, FindsACrowdTogether) {
  int with_a_map = 0;
  Explained all;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<int> names;
    NamelessWorld world(crowd_of_landmarks(), seed, 0.05);
    const Hypothesis hypothesis = driven(world, 25, &names);
    with_a_map += hypothesis.landmarks().size() >= 15 ? 1 : 0;
    const Explained bearings = explained(hypothesis, names);
    all.right += bearings.right;
    all.wrong += bearings.wrong;
  }
  RecordProperty("with_a_map", with_a_map);
  EXPECT_GE(with_a_map, 4);
  EXPECT_LT(4 * all.wrong, all.right);
}

// As dense as that, and nothing there.
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
  EXPECT_LE(found, 1U);  // in 250 images
}

}  // namespace
}  // namespace azimuth
