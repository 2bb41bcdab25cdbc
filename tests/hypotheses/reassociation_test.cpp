#include <gtest/gtest.h>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

TEST(Reassociation, UndoesAWrongPairWithTheNextImage) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const PoseId image = 11;
  std::vector<BearingId> of_something;
  for (BearingId id = hypothesis.first_bearing(image); id < hypothesis.first_bearing(image + 1); ++id)
    if (hypothesis.graph().landmark_of(id) != kOfNothing) of_something.push_back(id);
  ASSERT_GE(of_something.size(), 2U);
  const BearingId one = of_something[0], other = of_something[1];
  const LandmarkId a = hypothesis.graph().landmark_of(one), b = hypothesis.graph().landmark_of(other);
  hypothesis.assign(one, b);
  hypothesis.assign(other, a);

  hypothesis.add_image(world.motion(on_circle(13), on_circle(14)), world.sightings(on_circle(14), 6.0));
  EXPECT_EQ(hypothesis.graph().landmark_of(one), a);
  EXPECT_EQ(hypothesis.graph().landmark_of(other), b);
}

TEST(Reassociation, GivesBackWhatWasTakenAway) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const LandmarkId landmark = hypothesis.landmarks().front();
  const BearingId taken = hypothesis.graph().bearings_of(landmark).back();
  hypothesis.assign(taken, kOfNothing);
  hypothesis.add_image(world.motion(on_circle(13), on_circle(14)), world.sightings(on_circle(14), 6.0));
  EXPECT_EQ(hypothesis.graph().landmark_of(taken), landmark);
}

/// A bearing that fits badly, and may be clutter as well, is not assigned after only one or two images of hindsight.
TEST(Reassociation, WhatIsHardlyBetterThanNothingWaitsForHindsight) {
  int given_at_last = 0, waited = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    NamelessWorld world(ring_of_landmarks(), seed);
    Hypothesis hypothesis = driven(world, 14);
    const Motion there = world.motion(on_circle(13), on_circle(14));
    std::vector<NamelessSighting> seen = world.sightings(on_circle(14), 6.0);
    Hypothesis undisturbed = hypothesis;
    undisturbed.add_image(there, seen);
    const BearingId bearing = hypothesis.first_bearing(14);
    const LandmarkId landmark = undisturbed.graph().landmark_of(bearing);
    if (landmark == kOfNothing) continue;
    const Eigen::Vector2d p_body =
        inverse(undisturbed.smoother().newest_pose()) * undisturbed.graph().landmark(landmark).p_map();
    seen.front().azimuth_rad = wrap(std::atan2(p_body.y(), p_body.x()) + 3.2 * kSigma_rad);
    hypothesis.add_image(there, seen);
    hypothesis.assign(bearing, kOfNothing);
    bool early = false;
    for (int image = 15; image <= 17; ++image) {
      const Motion on = world.motion(on_circle(image - 1), on_circle(image));
      hypothesis.add_image(on, world.sightings(on_circle(image), 6.0));
      if (image < 17) early = early || hypothesis.graph().landmark_of(bearing) != kOfNothing;
    }
    if (hypothesis.graph().landmark_of(bearing) != landmark) continue;
    ++given_at_last;
    waited += early ? 0 : 1;
  }
  EXPECT_GE(given_at_last, 8);
  EXPECT_GE(2 * waited, given_at_last) << "of " << given_at_last << " only " << waited << " waited";
}

/// One bearing lies in the middle between two neighbouring landmarks. It stays with the landmark that it was assigned
/// to.
TEST(Reassociation, APairThatStandsStaysWhileNoRivalIsBetter) {
  const Eigen::Vector2d one(-7.99, 1.46), other(-8.06, 0.91);
  std::vector<Eigen::Vector2d> landmarks = ring_of_landmarks();
  landmarks.insert(landmarks.end(), {one, other});
  NamelessWorld world(landmarks);
  const PoseId last = 18;
  const Hypothesis hypothesis = driven(world, last);
  const Pose2 T_world_map = on_circle(0);
  const auto nearest = [&](const Eigen::Vector2d& p) {
    LandmarkId found = kOfNothing;
    double least_m = 0.27;
    for (const LandmarkId id : hypothesis.landmarks()) {
      const double off_m = (T_world_map * hypothesis.graph().landmark(id).p_map() - p).norm();
      if (off_m < least_m) found = id, least_m = off_m;
    }
    return found;
  };
  const LandmarkId a = nearest(one), b = nearest(other);
  ASSERT_NE(a, kOfNothing);
  ASSERT_NE(b, kOfNothing);
  ASSERT_NE(a, b);
  const Motion there = world.motion(on_circle(last - 1), on_circle(last));
  const Pose2 T_body_map = inverse(hypothesis.smoother().newest_pose() * there.T_start_end);
  const Eigen::Vector2d p_a = T_body_map * hypothesis.graph().landmark(a).p_map();
  const Eigen::Vector2d p_b = T_body_map * hypothesis.graph().landmark(b).p_map();
  const double middle_rad = 0.5 * (std::atan2(p_a.y(), p_a.x()) + std::atan2(p_b.y(), p_b.x()));
  std::vector<NamelessSighting> seen = world.sightings(on_circle(last), 6.0);
  std::erase_if(
      seen, [&](const NamelessSighting& sighting) { return std::abs(wrap(sighting.azimuth_rad - middle_rad)) < 0.2; });
  seen.push_back({middle_rad, kSigma_rad});
  Hypothesis before = hypothesis;
  before.add_image(there, seen);
  const BearingId between = before.graph().bearings() - 1;
  const Motion on = world.motion(on_circle(last), on_circle(last + 1));
  for (const LandmarkId said : {a, b}) {
    Hypothesis after = before;
    after.assign(between, said);
    after.add_image(on, {});
    EXPECT_EQ(after.graph().landmark_of(between), said);
  }
}

TEST(Reassociation, ALandmarkOfTwoBearingsDies) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const LandmarkId landmark = hypothesis.landmarks().front();
  while (hypothesis.graph().bearings_of(landmark).size() > 1)
    hypothesis.assign(hypothesis.graph().bearings_of(landmark).back(), kOfNothing);
  // The landmark's last bearing is too far off to remain its own.
  hypothesis.add_image(world.motion(on_circle(13), on_circle(14)), {});
  for (const LandmarkId id : hypothesis.landmarks()) EXPECT_GE(hypothesis.graph().bearings_of(id).size(), 3U);
}

}  // namespace
}  // namespace azimuth
