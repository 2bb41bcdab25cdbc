#include "tools/evaluate/map_error.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

using Points = std::vector<NamedPoint>;

NamedPoint at(double x_m, double y_m, double sigma_m = 0.0) {
  return {.p_m = {x_m, y_m}, .covariance_m2 = Eigen::Vector2d::Constant(sigma_m * sigma_m).asDiagonal()};
}

// True landmarks that span 20 m. The map may be bent by 0.4 m as a whole, and no match is farther than 2 m.
const Points kThree{at(0.0, 0.0), at(10.0, 0.0), at(20.0, 0.0)};

void expect_parts(const MapError& error, std::size_t matched, std::size_t duplicates, std::size_t phantoms) {
  EXPECT_EQ(error.matched, matched);
  EXPECT_EQ(error.duplicates, duplicates);
  EXPECT_EQ(error.phantoms, phantoms);
  EXPECT_EQ(error.landmarks, matched + duplicates + phantoms);
}

TEST(MapError, EveryLandmarkIsOneOfThree) {
  const Points map{at(0.0, 0.3), at(0.0, -0.39),   // two landmarks for one true landmark
                   at(10.0, 0.1), at(20.0, 0.5)};  // (20, 0.5) is too far off for its covariance
  const MapError error = map_error(map, kThree, Pose2{});
  EXPECT_EQ(error.true_landmarks, 3u);
  expect_parts(error, 2, 1, 1);
  EXPECT_DOUBLE_EQ(error.position_m.mean, 0.2);
  EXPECT_DOUBLE_EQ(error.position_m.max, 0.3);
  EXPECT_NEAR(error.pair_distance_rms_m, std::hypot(10.0, 0.2) - 10.0, 1e-12);
}

TEST(MapError, OneLandmarkIsNotTwoOfThoseThatStandSideBySide) {
  const Points world{at(0.0, 0.0), at(0.4, 0.0), at(20.0, 0.0)};
  const MapError error = map_error(Points{at(0.15, 0.0, 0.5)}, world, Pose2{});
  expect_parts(error, 1, 0, 0);
  EXPECT_DOUBLE_EQ(error.position_m.max, 0.15);
}

TEST(MapError, PairsAllTogetherNotEachForItself) {
  // The true landmark nearest to the first estimate goes to the second estimate, which has no other within reach.
  const Points map{at(1.1, 0.0, 0.5), at(1.4, 0.0, 0.05)};
  const Points world{at(0.0, 0.0), at(1.2, 0.0), at(20.0, 0.0)};
  const MapError error = map_error(map, world, Pose2{});
  expect_parts(error, 2, 0, 0);
  EXPECT_DOUBLE_EQ(error.position_m.max, 1.1);
}

TEST(MapError, ReachesAsFarAsTheCovarianceAndNoFartherThanATenth) {
  expect_parts(map_error(Points{at(20.0, 1.4)}, kThree, Pose2{}), 0, 0, 1);
  expect_parts(map_error(Points{at(20.0, 1.4, 0.5)}, kThree, Pose2{}), 1, 0, 0);
  expect_parts(map_error(Points{at(20.0, 1.6, 0.5)}, kThree, Pose2{}), 0, 0, 1);  // (1.5^2 + 0.4^2)^(1/2) = 1.55
  expect_parts(map_error(Points{at(20.0, 2.1, 5.0)}, kThree, Pose2{}), 0, 0, 1);
}

TEST(MapError, ReachesAlongTheCovarianceAsThePosesTurnIt) {
  NamedPoint long_one = at(0.0, -1.2);
  long_one.covariance_m2(1, 1) = 0.25;
  expect_parts(map_error(Points{long_one}, kThree, Pose2{}), 1, 0, 0);
  long_one.p_m = {1.2, 0.0};
  expect_parts(map_error(Points{long_one}, kThree, Pose2{}), 0, 0, 1);
  long_one.p_m = {0.0, 8.8};
  expect_parts(map_error(Points{long_one}, kThree, Pose2{20.0, 10.0, kPi}), 1, 0, 0);
  long_one.p_m = {0.0, 1.2};
  expect_parts(map_error(Points{long_one}, kThree, Pose2{0.0, 0.0, kPi / 2}), 1, 0, 0);
}

TEST(MapError, ReachesFartherInALargerMap) {
  Points large;
  for (const NamedPoint& truth : kThree) large.push_back(at(10.0 * truth.p_m.x(), 0.0));
  expect_parts(map_error(Points{at(0.0, 3.9)}, large, Pose2{}), 1, 0, 0);
  expect_parts(map_error(Points{at(0.0, 4.1)}, large, Pose2{}), 0, 0, 1);
}

TEST(MapError, UsesTheMotionOfThePoses) {
  const Pose2 T_world_map{4.0, -1.0, kPi / 2};
  const Points estimated{at(1.0, 0.0), at(0.0, 2.0)};
  const Points truth{at(4.0, 0.0), at(2.0, -1.0)};
  EXPECT_NEAR(map_error(estimated, truth, T_world_map).position_m.max, 0.0, 1e-12);
}

TEST(MapError, OfAnEmptyMapOrWorld) {
  const MapError empty_map = map_error({}, Points{at(0.0, 0.0)}, Pose2{});
  expect_parts(empty_map, 0, 0, 0);
  EXPECT_TRUE(std::isnan(empty_map.position_m.mean));
  expect_parts(map_error(Points{at(0.0, 0.0)}, {}, Pose2{}), 0, 0, 1);
}

TEST(MapError, WhatIsNotANumberMatchesNothing) {
  expect_parts(map_error(Points{at(kNotMeasured, 0.0)}, kThree, Pose2{}), 0, 0, 1);
  expect_parts(map_error(Points{at(INFINITY, 0.0)}, kThree, Pose2{}), 0, 0, 1);
  expect_parts(map_error(Points{at(0.0, 0.0, kNotMeasured)}, kThree, Pose2{}), 0, 0, 1);
  expect_parts(map_error(kThree, Points{at(kNotMeasured, 0.0)}, Pose2{}), 0, 0, 3);
}

TEST(NamedMapError, TellsNeighboursApart) {
  // Two landmarks are closer together than the error of the map, and their estimates have changed places.
  const std::vector<NamedPoint> truth{{7, {0.0, 0.0}}, {8, {0.2, 0.0}}, {9, {5.0, 0.0}}};
  const std::vector<NamedPoint> estimated{{7, {0.2, 0.0}}, {8, {0.0, 0.0}}, {kUnknownIdentity, {5.0, 0.0}}};
  EXPECT_DOUBLE_EQ(map_error(estimated, truth, Pose2{}).position_m.max, 0.0);
  const NamedMapError error = named_map_error(estimated, truth, Pose2{});
  EXPECT_EQ(error.named, 2u);
  EXPECT_EQ(error.duplicates, 0u);
  EXPECT_DOUBLE_EQ(error.position_m.mean, 0.2);
}

TEST(NamedMapError, CountsTheSameNameTwice) {
  const std::vector<NamedPoint> truth{{7, {0.0, 0.0}}};
  const std::vector<NamedPoint> estimated{{7, {3.0, 0.0}}, {7, {0.1, 0.0}}};
  const NamedMapError error = named_map_error(estimated, truth, Pose2{});
  EXPECT_EQ(error.named, 1u);
  EXPECT_EQ(error.duplicates, 1u);
  EXPECT_DOUBLE_EQ(error.position_m.max, 0.1);
}

TEST(NamedMapError, OfANameThatTwoTrueOnesHaveEachHasOne) {
  const std::vector<NamedPoint> truth{{7, {0.0, 0.0}}, {7, {5.0, 0.0}}};
  const NamedMapError error = named_map_error(std::vector<NamedPoint>{{7, {4.0, 0.0}}}, truth, Pose2{});
  EXPECT_EQ(error.named, 1u);
  EXPECT_DOUBLE_EQ(error.position_m.max, 1.0);
  const NamedMapError both =
      named_map_error(std::vector<NamedPoint>{{7, {4.0, 0.0}}, {7, {90.0, 0.0}}}, truth, Pose2{});
  EXPECT_EQ(both.named, 2u);
  EXPECT_EQ(both.duplicates, 0u);
}

TEST(NamedMapError, OfNamelessLandmarksIsNotMeasured) {
  const std::vector<NamedPoint> nameless{{kUnknownIdentity, {0.0, 0.0}}};
  EXPECT_EQ(named_map_error(nameless, nameless, Pose2{}).named, 0u);
}

TEST(SpaceMapError, CountsHeightsAndTurnsTheMap) {
  const Pose2 T_world_map{4.0, -1.0, kPi / 2};
  const std::vector<NamedPoint> truth{{.p_m = {4.0, 0.0}, .z_m = 6.5},
                                      {.p_m = {2.0, -1.0}, .z_m = 6.5},
                                      {.p_m = {23.0, 9.0}, .z_m = 6.5},
                                      {.p_m = {4.0, 0.0}}};                                   // has no known height
  const std::vector<NamedPoint> estimated{{.p_m = {1.0, 0.3}, .z_m = 6.9, .sigma_z_m = 0.1},  // 0.5 m from the first
                                          {.p_m = {0.0, 2.0}, .z_m = 6.3},                    // 0.2 m below the second
                                          {.p_m = {0.0, 2.0}, .z_m = 6.2},                    // a duplicate of it
                                          {.p_m = {10.0, -19.0}, .z_m = 8.1, .sigma_z_m = 0.3},  // too high
                                          {.p_m = {0.0, 2.0}}};                                  // in the plane only
  const SpaceMapError error = space_map_error(estimated, truth, T_world_map);
  EXPECT_EQ(error.landmarks, 4u);
  EXPECT_EQ(error.true_landmarks, 3u);
  EXPECT_EQ(error.matched, 2u);
  EXPECT_EQ(error.duplicates, 1u);
  EXPECT_EQ(error.phantoms, 1u);
  EXPECT_NEAR(error.position_m.mean, 0.35, 1e-12);
  EXPECT_NEAR(error.position_m.max, 0.5, 1e-12);
  EXPECT_NEAR(error.height_mean_m, 0.1, 1e-12);
}

TEST(SpaceMapError, OfAMapInThePlaneIsNotMeasured) {
  const std::vector<NamedPoint> flat{{.p_m = {0.0, 0.0}}}, high{{.p_m = {0.0, 0.0}, .z_m = 3.0}};
  for (const SpaceMapError& error : {space_map_error(flat, high, Pose2{}), space_map_error(high, flat, Pose2{}),
                                     space_map_error({}, high, Pose2{})}) {
    EXPECT_EQ(error.matched, 0u);
    EXPECT_TRUE(std::isnan(error.position_m.mean));
    EXPECT_TRUE(std::isnan(error.height_mean_m));
  }
}

using Places = std::vector<Eigen::Vector2d>;

TEST(PairDistanceError, Golden) {
  const Places a{{0.0, 0.0}, {4.0, 0.1}, {4.1, 3.0}, {0.2, 2.8}};
  const Places b{{1.0, 1.0}, {4.4, 3.1}, {2.9, 5.6}, {-0.6, 3.5}};
  const PairDistanceError error = pair_distance_error(a, b);
  EXPECT_NEAR(error.sum_squared_m2, 0.193625404939476, 1e-9);
  EXPECT_NEAR(error.rms_m, 0.1796410332391962, 1e-9);
}

TEST(PairDistanceError, NeedsTwoPlaces) {
  EXPECT_TRUE(std::isnan(pair_distance_error(Places{{1.0, 1.0}}, Places{{1.0, 2.0}}).rms_m));
}

}  // namespace
}  // namespace azimuth
