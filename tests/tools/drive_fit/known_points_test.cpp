// Tests the fit of found landmarks to measured points, which tells the scale and a mirrored map.

#include "tools/drive_fit/known_points.hpp"

#include <gtest/gtest.h>

#include "tests/support/drive_of.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// Points in the shape of an L, and the same points rotated, scaled and, on request, mirrored.
std::vector<KnownPoint> points(double scale, bool mirrored) {
  const Pose2 T{3.0, -1.0, 0.7};
  std::vector<KnownPoint> result;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2d found = i < 6 ? Eigen::Vector2d(i, 0.0) : Eigen::Vector2d(0.0, i - 5.0);
    const Eigen::Vector2d seen(found.x(), mirrored ? -found.y() : found.y());
    result.push_back({found, T * Eigen::Vector2d(scale * seen)});
  }
  return result;
}

TEST(Likeness, TellsScaleAndHand) {
  for (const bool mirrored : {false, true}) {
    const auto like = likeness(points(1.3, mirrored));
    ASSERT_TRUE(like);
    EXPECT_NEAR(like->lengths.scale, 1.3, 1e-9);
    EXPECT_LT(like->lengths.sigma, 1e-6);
    EXPECT_TRUE(like->hand_told);
    EXPECT_EQ(like->mirrored, mirrored);
  }
}

TEST(Likeness, OfALineTellsNoHand) {
  std::vector<KnownPoint> line = points(1.0, false);
  line.resize(6);
  const auto like = likeness(line);
  ASSERT_TRUE(like);
  EXPECT_FALSE(like->hand_told);
}

TEST(Likeness, OfTooFewPointsOrOnePlaceTellsNothing) {
  const std::vector<KnownPoint> many = points(1.0, false);
  EXPECT_FALSE(likeness(std::span(many).first(3)));
  EXPECT_FALSE(likeness(std::vector<KnownPoint>(8)));
}

TEST(KnownPoints, ADistanceOfTwoLandmarksTellsTheScale) {
  const auto run = test::with_scaled_distances(simulated_run(lab(31, 1)), 1.25);
  const Rig rig = test::rig_of_run(run);
  const Drive drive = test::drive_of(run, rig);
  const HindsightSettings settings;
  const DriveSolution solution = solved(drive, followed(drive, {.rig = rig}, {}, settings), {.rig = rig}, {}, settings);
  const TrueLandmark &a = run.landmarks[0], &b = run.landmarks[7];
  const double distance_m = std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  const auto scale = scale_between(drive, solution, settings, a.identity, b.identity, distance_m);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(scale->scale, 0.8, 4.0 * scale->sigma + 0.005);
  EXPECT_LT(scale->sigma, 0.02);
  EXPECT_FALSE(scale_between(drive, solution, settings, a.identity, 9999, 1.0));
  const auto by_map = likeness(points_of_map(solution, run.landmarks));
  const auto by_path = likeness(points_on_path(solution, run.truth));
  ASSERT_TRUE(by_map && by_path);
  EXPECT_NEAR(by_map->lengths.scale, 0.8, 0.02);
  EXPECT_NEAR(by_path->lengths.scale, 0.8, 0.02);
}

}  // namespace
}  // namespace azimuth
