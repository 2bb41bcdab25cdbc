#include <gtest/gtest.h>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

constexpr int kDarkFrom = 20, kDarkTo = 32, kWholeDrive = 44;

/// Two thirds of a lap, a stretch without bearings in which the robot slips and its covariance grows, and the rest of
/// the drive. The window is too short to map anything new in between.
Hypothesis slipped(unsigned seed, const Pose2& slip) {
  NamelessWorld world(ring_of_landmarks(), seed);
  Hypothesis hypothesis(world_settings(), {.window = 3});
  hypothesis.adopt(driven(world, kDarkFrom));
  for (int i = kDarkFrom; i < kWholeDrive; ++i) {
    Motion motion = world.motion(on_circle(i - 1), on_circle(i));
    if (i == kDarkTo) {
      motion.T_start_end = motion.T_start_end * slip;
      motion.covariance.diagonal() << 0.49, 0.49, 0.12;
    }
    hypothesis.add_image(motion, i < kDarkTo ? std::vector<NamelessSighting>() : world.sightings(on_circle(i), 6.0));
  }
  return hypothesis;
}

double off_m(const Hypothesis& hypothesis) {
  const Pose2 truth = inverse(on_circle(0)) * on_circle(hypothesis.images() - 1);
  return (hypothesis.smoother().newest_pose().position() - truth.position()).norm();
}

TEST(Loops, AreClosedBySeveralImagesWhereNoneClosesThemAlone) {
  int lost = 0, closed = 0, right = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Hypothesis hypothesis = slipped(seed, {1.3, -0.9, 0.5});
    if (off_m(hypothesis) < 0.5) continue;  // the hypothesis has corrected itself
    ++lost;
    const double energy = hypothesis.energy();
    if (!hypothesis.close_loop()) continue;
    ++closed;
    EXPECT_LT(hypothesis.energy(), energy) << seed;
    right += off_m(hypothesis) < 0.3 ? 1 : 0;
  }
  RecordProperty("lost", lost);
  EXPECT_GE(lost, 3);
  EXPECT_GE(closed, lost - 1);
  EXPECT_EQ(right, closed);
}

TEST(Loops, WhatIsExplainedWellIsLeftAsItIs) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 40);
  const Pose2 before = hypothesis.smoother().newest_pose();
  EXPECT_FALSE(hypothesis.close_loop());
  EXPECT_EQ(hypothesis.smoother().newest_pose(), before);
}

TEST(Loops, NothingIsLookedForBeforeThereIsAMap) {
  NamelessWorld world(ring_of_landmarks());
  for (const int images : {1, 2, 12, 13}) {
    Hypothesis hypothesis = driven(world, images);
    EXPECT_FALSE(hypothesis.close_loop()) << images;
  }
}

}  // namespace
}  // namespace azimuth
