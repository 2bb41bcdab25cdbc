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

TEST(Reassociation, ALandmarkOfTwoBearingsDies) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const LandmarkId landmark = hypothesis.landmarks().front();
  while (hypothesis.graph().bearings_of(landmark).size() > 1)
    hypothesis.assign(hypothesis.graph().bearings_of(landmark).back(), kOfNothing);
  // Its last bearing cannot be its own any more: it is far off.
  hypothesis.add_image(world.motion(on_circle(13), on_circle(14)), {});
  for (const LandmarkId id : hypothesis.landmarks()) EXPECT_GE(hypothesis.graph().bearings_of(id).size(), 3U);
}

}  // namespace
}  // namespace azimuth
