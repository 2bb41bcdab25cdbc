#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

#include "slam/hypotheses/scene.hpp"

namespace azimuth {
namespace {

constexpr double kAllRound_rad = 2.0 * std::numbers::pi;

BearingGraph graph_with(int bearings, double within_rad) {
  BearingGraph graph({}, {});
  for (int i = 0; i < bearings; ++i) graph.add_bearing(within_rad * (2.0 * (i + 0.5) / bearings - 1.0), 0.02);
  return graph;
}

TEST(ViewByExperience, IsAsGivenBeforeAnythingWasSeen) {
  EXPECT_EQ(field_of_view_by_experience(kAllRound_rad, graph_with(0, 1.0)), kAllRound_rad);
}

TEST(ViewByExperience, AFewBearingsAheadSayLittle) {
  EXPECT_EQ(field_of_view_by_experience(kAllRound_rad, graph_with(19, 0.5)), kAllRound_rad);
}

TEST(ViewByExperience, ManyBearingsAheadSayThatNothingIsSeenBehind) {
  const double view_rad = field_of_view_by_experience(kAllRound_rad, graph_with(200, 1.5));
  EXPECT_GT(view_rad, 3.0);
  EXPECT_LT(view_rad, 3.1);
}

TEST(ViewByExperience, IsNeverWiderThanGiven) {
  EXPECT_EQ(field_of_view_by_experience(1.0, graph_with(200, 1.5)), 1.0);
}

/// A straight drive past landmarks with the true map and path. The landmarks are seen up to `seen_m`.
struct DrivePast {
  double seen_m = 6.0;
  double detection_probability = 0.8;
  double falsely_seen = 0.0;  ///< Share of images in which a landmark beyond that is falsely seen
  double field_of_view_rad = kAllRound_rad;
  double length_m = 30.0;
  std::vector<Eigen::Vector2d> landmarks;

  std::vector<LandmarkId> into(BearingGraph& graph) const {
    constexpr double kStep_m = 0.5, kSigma_rad = 0.02;
    std::mt19937_64 numbers(1);
    std::uniform_real_distribution<double> uniform;
    std::vector<std::vector<BearingId>> bearings_of(landmarks.size());
    Motion motion;
    motion.T_start_end.x_m = kStep_m;
    motion.covariance = Eigen::Matrix3d::Identity() * 1e-4;
    for (int image = 0; kStep_m * image < length_m; ++image) {
      if (image > 0) graph.add_pose(motion);
      for (std::size_t i = 0; i < landmarks.size(); ++i) {
        const Eigen::Vector2d away = landmarks[i] - graph.pose(image).position();
        const double azimuth_rad = std::atan2(away.y(), away.x());
        const double probability = away.norm() > seen_m ? falsely_seen : detection_probability;
        if (std::abs(azimuth_rad) > 0.5 * field_of_view_rad || uniform(numbers) >= probability) continue;
        bearings_of[i].push_back(graph.add_bearing(azimuth_rad, kSigma_rad));
      }
    }
    std::vector<LandmarkId> mapped;
    BearingGraph::Values values = graph.values();
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      if (bearings_of[i].empty()) continue;
      mapped.push_back(graph.add_landmark(bearings_of[i].front()));
      for (const BearingId bearing : bearings_of[i]) graph.assign(bearing, mapped.back());
      const Eigen::Vector2d from = graph.pose(graph.bearing(bearings_of[i].front()).pose).position();
      const Eigen::Vector2d away = landmarks[i] - from;
      values.landmarks.emplace_back(from, std::atan2(away.y(), away.x()), 1.0 / away.norm());
      values.tangents.push_back(std::nan(""));
    }
    graph.begin_at(values);
    return mapped;
  }

  RangeBelief range(const Scene& given = {}) const {
    BearingGraph graph({}, {});
    const std::vector<LandmarkId> mapped = into(graph);
    return range_by_experience(given, graph, mapped);
  }
};

std::vector<Eigen::Vector2d> on_both_sides() {
  std::vector<Eigen::Vector2d> landmarks;
  for (int i = 0; i < 12; ++i) landmarks.emplace_back(2.7 * i, (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + 0.3 * (i % 5)));
  return landmarks;
}

class RangeByExperience : public testing::TestWithParam<double> {};

TEST_P(RangeByExperience, IsHowFarLandmarksWereSeen) {
  const RangeBelief range = DrivePast{.seen_m = GetParam(), .landmarks = on_both_sides()}.range();
  EXPECT_NEAR(range.range_m, GetParam(), 0.06 * GetParam());
  EXPECT_LT(range.doubt, 0.15);
}

TEST_P(RangeByExperience, LittleOfWhatIsSeenFurtherOffMayBeFalse) {
  const RangeBelief range = DrivePast{.seen_m = GetParam(), .falsely_seen = 0.05, .landmarks = on_both_sides()}.range();
  EXPECT_NEAR(range.range_m, GetParam(), 0.1 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(ShorterAndLongerThanGiven, RangeByExperience, testing::Values(3.5, 5.0, 6.0, 8.0, 10.0));

TEST(RangeByExperience, IsAsGivenBeforeAnythingWasSeen) {
  const BearingGraph graph({}, {});
  const RangeBelief range = range_by_experience({}, graph, {});
  EXPECT_NEAR(range.range_m, Scene{}.range_m, 1e-9);
  EXPECT_NEAR(range.doubt, Scene{}.range_doubt, 1e-3);
}

TEST(RangeByExperience, ASmallRoomDoesNotTellHowFarIsSeen) {
  const DrivePast room{
      .detection_probability = 1.0, .length_m = 4.0, .landmarks = {{0.0, 1.0}, {3.5, 1.0}, {3.5, -1.0}, {0.0, -1.0}}};
  const Scene given;
  const RangeBelief range = room.range(given);
  EXPECT_GT(range.range_m, given.range_m) << "nothing was told, not even that it is not less than the room";
  EXPECT_NEAR(range.range_m * (1.0 + range.doubt), given.asked_within_m(), 0.05 * given.asked_within_m());
}

TEST(RangeByExperience, WhatIsOutOfViewIsNotMissed) {
  const DrivePast ahead{
      .seen_m = 5.0, .detection_probability = 1.0, .field_of_view_rad = std::numbers::pi, .landmarks = on_both_sides()};
  Scene given;
  given.detection_probability = 0.99;  // otherwise misses behind the robot outweigh the detections
  const double as_if_all_round_m = ahead.range(given).range_m;
  given.field_of_view_rad = ahead.field_of_view_rad;
  const double range_m = ahead.range(given).range_m;
  EXPECT_NEAR(range_m, 5.0, 0.3);
  EXPECT_LT(as_if_all_round_m, range_m - 0.5);
}

TEST(RangeByExperience, WhereItIsSaidToBeCertainItIsAsGiven) {
  Scene given;
  given.range_doubt = Scene::kLeastRangeDoubt;
  const RangeBelief range = DrivePast{.seen_m = 3.5, .landmarks = on_both_sides()}.range(given);
  EXPECT_EQ(range.range_m, given.range_m);
  EXPECT_EQ(range.doubt, given.range_doubt);
}

TEST(SceneByExperience, ThroughANarrowViewTheRangeIsAsGiven) {
  Scene given;
  given.field_of_view_rad = 1.0;
  BearingGraph graph({}, {});
  const std::vector<LandmarkId> mapped =
      DrivePast{.seen_m = 8.0, .field_of_view_rad = 1.0, .landmarks = on_both_sides()}.into(graph);
  EXPECT_GT(range_by_experience(given, graph, mapped).range_m, given.range_m + 1.0);
  EXPECT_EQ(scene_by_experience(given, graph, mapped).range_m, given.range_m);
}

}  // namespace
}  // namespace azimuth
