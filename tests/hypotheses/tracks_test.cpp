// Tracks for cameras with a forward field of view.

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

constexpr double kHalfView_rad = 0.8;

HypothesisSettings narrow_settings() {
  HypothesisSettings settings = world_settings();
  settings.scene.field_of_view_rad = 2.0 * kHalfView_rad;
  settings.costs = hypothesis_costs(settings.scene, settings.smoother);
  settings.tracks.used = true;
  return settings;
}

std::vector<NamelessSighting> ahead(NamelessWorld& world, int image) {
  std::vector<NamelessSighting> sightings = world.sightings(on_circle(image), 6.0);
  std::erase_if(sightings, [](const NamelessSighting& s) { return std::abs(s.azimuth_rad) > kHalfView_rad; });
  return sightings;
}

Hypothesis driven_ahead(NamelessWorld& world, int images) {
  Hypothesis hypothesis(narrow_settings(), {});
  hypothesis.begin(ahead(world, 0));
  for (int i = 1; i < images; ++i)
    hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), ahead(world, i), 0.5);
  return hypothesis;
}

TEST(Tracks, EachBearingOfNothingIsALandmarkAtOnce) {
  NamelessWorld world({{3.0, 4.0}});
  Hypothesis hypothesis(narrow_settings(), {});
  hypothesis.begin(std::vector{NamelessSighting{0.1, kSigma_rad}, NamelessSighting{-0.4, kSigma_rad}});
  EXPECT_EQ(hypothesis.landmarks().size(), 2U);
}

TEST(Tracks, OneThatIsNotSeenAgainIsGone) {
  NamelessWorld world({});
  Hypothesis hypothesis(narrow_settings(), {});
  hypothesis.begin(std::vector{NamelessSighting{0.1, kSigma_rad}});
  for (int i = 1; i < 6; ++i) hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), {}, 0.5);
  EXPECT_EQ(hypothesis.landmarks().size(), 1U);
  for (int i = 6; i < 9; ++i) hypothesis.add_image(world.motion(on_circle(i - 1), on_circle(i)), {}, 0.5);
  EXPECT_TRUE(hypothesis.landmarks().empty());
}

TEST(Tracks, WhatIsSeenAgainAfterALapIsOneLandmark) {
  NamelessWorld world(ring_of_landmarks(), 4);
  constexpr int kTwoLaps = 80;  // two and a half laps
  const Hypothesis hypothesis = driven_ahead(world, kTwoLaps);
  EXPECT_GE(hypothesis.landmarks().size(), 7U);
  EXPECT_LE(hypothesis.landmarks().size(), 11U);
  const Pose2 truth = inverse(on_circle(0)) * on_circle(kTwoLaps - 1);
  Eigen::Vector3d off = truth.vector() - hypothesis.smoother().newest_pose().vector();
  off.z() = wrap(off.z());
  EXPECT_LT(off.dot(hypothesis.smoother().newest_covariance().inverse() * off), 16.3);  // 99.9 % quantile
  EXPECT_LT(off.head<2>().norm(), 0.3);
}

}  // namespace
}  // namespace azimuth
