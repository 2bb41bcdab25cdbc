#include "tools/evaluate/map_error.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(MapError, MatchesNearestWithinItsLimits) {
  const Points truth{{0.0, 0.0}, {10.0, 0.0}, {20.0, 0.0}};
  const Points estimated{{0.3, 0.4},    // 0.5 m from the first
                         {0.6, 0.4},    // a duplicate of it
                         {10.0, 1.0},   // 1 m from the second
                         {11.4, 1.0},   // too far from it for a duplicate
                         {20.0, 1.6}};  // too far from the third for a match
  const MapError error = map_error(estimated, truth, Pose2{});
  EXPECT_EQ(error.landmarks, 5u);
  EXPECT_EQ(error.true_landmarks, 3u);
  EXPECT_EQ(error.matched, 2u);
  EXPECT_EQ(error.duplicates, 1u);
  EXPECT_DOUBLE_EQ(error.position_m.mean, 0.75);
  EXPECT_DOUBLE_EQ(error.position_m.max, 1.0);
  EXPECT_NEAR(error.pair_distance_rms_m, std::abs(std::hypot(9.7, 0.6) - 10.0), 1e-12);
}

TEST(MapError, UsesTheMotionOfThePoses) {
  const Pose2 T_world_map{4.0, -1.0, kPi / 2};
  const Points estimated{{1.0, 0.0}, {0.0, 2.0}};
  const Points truth{{4.0, 0.0}, {2.0, -1.0}};
  EXPECT_NEAR(map_error(estimated, truth, T_world_map).position_m.max, 0.0, 1e-12);
}

TEST(MapError, OfAnEmptyMapOrWorld) {
  const MapError empty_map = map_error({}, Points{{0.0, 0.0}}, Pose2{});
  EXPECT_EQ(empty_map.matched, 0u);
  EXPECT_TRUE(std::isnan(empty_map.position_m.mean));
  const MapError empty_world = map_error(Points{{0.0, 0.0}}, {}, Pose2{});
  EXPECT_EQ(empty_world.landmarks, 1u);
  EXPECT_EQ(empty_world.duplicates, 0u);
}

TEST(MapError, AnEstimateThatIsNotANumberMatchesNothing) {
  const MapError error = map_error(Points{{kNotMeasured, 0.0}}, Points{{0.0, 0.0}}, Pose2{});
  EXPECT_EQ(error.matched, 0u);
}

TEST(NamedMapError, TellsNeighboursApart) {
  // Two landmarks closer together than the map is wrong: their estimates have changed places.
  const std::vector<NamedPoint> truth{{7, {0.0, 0.0}}, {8, {0.2, 0.0}}, {9, {5.0, 0.0}}};
  const std::vector<NamedPoint> estimated{{7, {0.2, 0.0}}, {8, {0.0, 0.0}}, {kUnknownIdentity, {5.0, 0.0}}};
  EXPECT_DOUBLE_EQ(map_error(Points{{0.2, 0.0}, {0.0, 0.0}}, Points{{0.0, 0.0}, {0.2, 0.0}}, Pose2{}).position_m.max,
                   0.0);
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

TEST(NamedMapError, OfNamelessLandmarksIsNotMeasured) {
  const std::vector<NamedPoint> nameless{{kUnknownIdentity, {0.0, 0.0}}};
  EXPECT_EQ(named_map_error(nameless, nameless, Pose2{}).named, 0u);
}

TEST(SpaceMapError, CountsHeightsAndTurnsTheMap) {
  const Pose2 T_world_map{4.0, -1.0, kPi / 2};
  const std::vector<NamedPoint> truth{{.p_m = {4.0, 0.0}, .z_m = 6.5},
                                      {.p_m = {2.0, -1.0}, .z_m = 6.5},
                                      {.p_m = {9.0, 9.0}, .z_m = 6.5},
                                      {.p_m = {4.0, 0.0}}};                   // of which no height is known
  const std::vector<NamedPoint> estimated{{.p_m = {1.0, 0.3}, .z_m = 6.9},    // 0.5 m from the first
                                          {.p_m = {0.0, 2.0}, .z_m = 6.3},    // 0.2 m below the second
                                          {.p_m = {10.0, -5.0}, .z_m = 8.1},  // too high above the third
                                          {.p_m = {0.0, 2.0}}};               // in the plane only
  const SpaceMapError error = space_map_error(estimated, truth, T_world_map);
  EXPECT_EQ(error.landmarks, 3u);
  EXPECT_EQ(error.true_landmarks, 3u);
  EXPECT_EQ(error.matched, 2u);
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

TEST(PairDistanceError, Golden) {
  const Points a{{0.0, 0.0}, {4.0, 0.1}, {4.1, 3.0}, {0.2, 2.8}};
  const Points b{{1.0, 1.0}, {4.4, 3.1}, {2.9, 5.6}, {-0.6, 3.5}};
  const PairDistanceError error = pair_distance_error(a, b);
  EXPECT_NEAR(error.sum_squared_m2, 0.193625404939476, 1e-9);
  EXPECT_NEAR(error.rms_m, 0.1796410332391962, 1e-9);
}

TEST(PairDistanceError, NeedsTwoPoints) {
  EXPECT_TRUE(std::isnan(pair_distance_error(Points{{1.0, 1.0}}, Points{{1.0, 2.0}}).rms_m));
}

}  // namespace
}  // namespace azimuth
