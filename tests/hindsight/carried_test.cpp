// Evidence that a robot is being carried: landmarks seen a moment ago that are missing, and bearings that move while
// the wheels stand still.

#include "slam/hindsight/carried.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaSeen_rad = 0.02;

BearingSet image(double at_s, const std::vector<double>& azimuths_rad, Identity first = 0) {
  BearingSet set;
  set.stamp = Stamp{duration_from_seconds(at_s)};
  for (const double azimuth_rad : azimuths_rad) {
    Bearing& bearing = set.bearings.emplace_back();
    bearing.azimuth_rad = wrap(azimuth_rad);
    bearing.identity = first++;
  }
  return set;
}

TEST(NamesSeen, AreDueInTheNextImages) {
  NamesSeen seen;
  EXPECT_FALSE(seen.is_due(0, 0.0));
  seen.add(image(0.0, {0.0, 1.0}), 0.0);
  EXPECT_TRUE(seen.is_due(0, 0.0));
  EXPECT_TRUE(seen.is_due(1, 1.0));
  EXPECT_FALSE(seen.is_due(2, 0.0));
  EXPECT_FALSE(seen.is_due(0, 2.0));  // too far from the place of the sighting
}

TEST(NamesSeen, AreForgottenAfterThreeImages) {
  NamesSeen seen;
  seen.add(image(0.0, {0.0}), 0.0);
  for (int i = 1; i <= 2; ++i) seen.add(image(i, {0.0}, 5), 0.0);
  EXPECT_TRUE(seen.is_due(0, 0.0));
  seen.add(image(3.0, {0.0}, 5), 0.0);
  EXPECT_FALSE(seen.is_due(0, 0.0));
}

TEST(NamesSeen, AreMissedInThreeImagesAtMost) {
  NamesSeen seen;
  seen.add(image(0.0, {0.0}), 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(seen.is_due(0, 0.0)) << i;
    seen.pass_over();
  }
  EXPECT_FALSE(seen.is_due(0, 0.0));
  seen.add(image(1.0, {0.0}), 0.0);
  EXPECT_TRUE(seen.is_due(0, 0.0));
}

/// A robot at standstill, with an image every 0.2 s.
struct Standing {
  RestWatch watch{true};
  double at_s = 0.0;

  void see(double turned_rad, int images = 1) {
    for (int i = 0; i < images; ++i, at_s += 0.2)
      watch.add(image(at_s, {turned_rad, 1.0 + turned_rad, 2.0 + turned_rad, 3.0 + turned_rad}), kSigmaSeen_rad, 1.0);
  }
};

TEST(RestWatch, SeesThatARobotIsLifted) {
  Standing robot;
  robot.see(0.0, 10);
  EXPECT_FALSE(robot.watch.is_carried());
  robot.see(0.3);
  EXPECT_TRUE(robot.watch.is_carried());
}

TEST(RestWatch, BelievesThatItStandsAgainAfterThreeSeconds) {
  Standing robot;
  robot.see(0.0, 10);
  for (int i = 1; i <= 10; ++i) robot.see(0.3 * i);
  robot.see(3.0, 14);
  EXPECT_TRUE(robot.watch.is_carried());
  robot.see(3.0, 2);
  EXPECT_FALSE(robot.watch.is_carried());
}

TEST(RestWatch, BelievesOdometryThatMoves) {
  Standing robot;
  robot.see(0.0, 10);
  robot.see(0.3);
  Motion motion;
  motion.path_m = 0.1;
  robot.watch.predict(motion);
  robot.see(0.5);
  EXPECT_FALSE(robot.watch.is_carried());
}

TEST(RestWatch, AllowsForImagesThatAreLate) {
  Standing robot;
  Motion motion;
  motion.T_start_end.heading_rad = 0.2;
  for (int i = 0; i < 10; ++i) {
    robot.watch.predict(motion);
    robot.see(0.2 * i);
  }
  for (int i = 10; i < 14; ++i) robot.see(0.2 * i);  // images taken during the turn arrive after odometry has ended it
  robot.see(2.6, 20);
  EXPECT_FALSE(robot.watch.is_carried());
}

TEST(RestWatch, DoesNotMindALandmarkThatIsMoved) {
  RestWatch watch{true};
  for (int i = 0; i < 40; ++i) watch.add(image(0.2 * i, {0.0, 1.0, 2.0, i < 20 ? 3.0 : 2.5}), kSigmaSeen_rad, 1.0);
  EXPECT_FALSE(watch.is_carried());
}

/// An image of twelve landmarks all round without identities. Each image misses two landmarks and contains one clutter
/// bearing.
BearingSet unnamed_image(int number, double turned_rad) {
  std::vector<double> azimuths_rad;
  for (int i = 0; i < 12; ++i)
    if (i % 6 != number % 6) azimuths_rad.push_back(0.5 * i + turned_rad);
  azimuths_rad.push_back(0.25 + 0.5 * (number % 7));
  BearingSet set = image(0.2 * number, azimuths_rad);
  for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  return set;
}

TEST(RestWatch, NeedsNoNames) {
  RestWatch watch{false};
  for (int i = 0; i < 40; ++i) {
    watch.add(unnamed_image(i, 0.0), kSigmaSeen_rad, 1.0);
    ASSERT_FALSE(watch.is_carried()) << i;
  }
  watch.add(unnamed_image(40, 0.2), kSigmaSeen_rad, 1.0);
  EXPECT_TRUE(watch.is_carried());
  for (int i = 41; i < 60; ++i) watch.add(unnamed_image(i, 0.2), kSigmaSeen_rad, 1.0);
  EXPECT_FALSE(watch.is_carried()) << "it stands again";
}

TEST(RestWatch, PassesOverWhatHasNoNameAmongNames) {
  RestWatch watch{true};
  for (int i = 0; i < 40; ++i) watch.add(unnamed_image(i, 0.1 * i), kSigmaSeen_rad, 1.0);
  EXPECT_FALSE(watch.is_carried());
}

}  // namespace
}  // namespace azimuth
