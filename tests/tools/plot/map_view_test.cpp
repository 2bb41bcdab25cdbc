#include "tools/plot/map_view.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

using testing::HasSubstr;

UncertainPoint point(double x_m, double y_m, double sigma_m) {
  return {{x_m, y_m}, sigma_m * sigma_m * Eigen::Matrix2d::Identity()};
}

/// The picture of a drive from the origin to (10, 4) and back.
MapPicture drive() {
  MapPicture picture;
  picture.estimate = {{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {0.0, 4.0}}, false}};
  return picture;
}

Box view(const MapPicture& picture) {
  const Extent extent = view_of(picture);
  return {extent.low_m, extent.high_m};
}

TEST(MapView, ShowsThePathAndTheLandmarksAroundIt) {
  MapPicture picture = drive();
  picture.landmarks = {{point(5.0, 9.0, 0.05), "", -1, true}};
  EXPECT_TRUE(view(picture).contains({5.0, 9.0}));
  EXPECT_TRUE(view(picture).contains({10.0, 0.0}));
}

TEST(MapView, IsNotMadeSmallByWhatIsHardlyKnown) {
  const Box before = view(drive());
  MapPicture picture = drive();
  picture.estimate.push_back({{{0.0, 4.0}, {900.0, -400.0}}, true});
  picture.landmarks = {{point(50.0, -3.0, 7.0), "", -1, true}, {point(30.0, 2.0, 0.1), "", -1, false}};
  const Box after = view(picture);
  EXPECT_TRUE(after.low.isApprox(before.low)) << "a lost stretch and landmarks that are hardly known";
  EXPECT_TRUE(after.high.isApprox(before.high));
}

TEST(MapView, MakesNoRoomForALandmarkThatStaysOutside) {
  MapPicture picture = drive();
  picture.landmarks = {{point(-40.0, 2.0, 0.1), "", -1, true}};
  EXPECT_TRUE(view(picture).low.isApprox(view(drive()).low));
}

TEST(MapView, OfALostRobotIsStillOfASize) {
  MapPicture picture;
  picture.estimate = {{{{3.0, 3.0}, {4.0, 3.0}}, true}};
  const Extent extent = view_of(picture);
  EXPECT_GT(extent.size_m().minCoeff(), 0.9);
}

TEST(LeftOut, CountsWhatIsOutsideOfTheFrame) {
  MapPicture picture = drive();
  picture.odometry = {{0.0, 0.0}, {5.0, 1.0}, {90.0, 0.0}, {91.0, 0.0}};
  picture.landmarks = {{point(5.0, 3.0, 0.1), "", -1, true},
                       {point(50.0, 3.0, 0.1), "", -1, true},
                       {point(NAN, 3.0, 0.1), "", -1, true}};
  picture.true_landmarks = {{5.0, 3.0}, {-70.0, 0.0}};
  picture.poses = {point(1.0, 1.0, 0.1), point(2.0, 1.0, 141.0)};
  const Box shown{{-1.0, -1.0}, {11.0, 6.0}};
  const LeftOut counts = left_out(picture, shown);
  EXPECT_EQ(counts.landmarks, 2U);
  EXPECT_EQ(counts.of_landmarks, 3U);
  EXPECT_EQ(counts.true_landmarks, 1U);
  EXPECT_EQ(counts.estimates, 0U);
  EXPECT_EQ(counts.odometry, 2U);
  EXPECT_EQ(counts.pose_ellipses, 1U);
  const std::string text = words(counts, "landmark");
  EXPECT_THAT(text, HasSubstr("2 of 3 landmarks, 1 true landmark, 50 % of the odometry"));
  EXPECT_THAT(text, HasSubstr("1 ellipse of the position, larger than the view"));
}

TEST(LeftOut, SaysNothingWhenAllIsThere) { EXPECT_EQ(words(left_out(drive(), view(drive())), "landmark"), ""); }

TEST(LeftOut, ALandmarkOfAnEllipseLargerThanTheViewIsHardlyKnown) {
  EXPECT_TRUE(is_well_known({point(0.0, 0.0, 0.5), "", -1, true}, 10.0));
  EXPECT_FALSE(is_well_known({point(0.0, 0.0, 3.0), "", -1, true}, 10.0));
  EXPECT_FALSE(is_well_known({point(0.0, 0.0, 0.5), "", -1, false}, 10.0));
}

}  // namespace
}  // namespace azimuth
