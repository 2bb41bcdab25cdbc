// Components of estimators: the book of landmarks, the decision how to start on a map, and the evidence for health.

#include <gtest/gtest.h>
#include <vector>

#include "slam/estimator/landmark_book.hpp"
#include "slam/estimator/recognition_history.hpp"
#include "slam/estimator/start_from_map.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {
namespace {

struct Entry {
  std::int64_t id = 0;
  int what = 0;
};

TEST(LandmarkBook, NeverGivesAnIdentifierTwice) {
  LandmarkBook<Entry> book;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(book.add({.what = i}).id, i);
  book.remove(book.index_of(1));
  book.remove(book.index_of(4));
  EXPECT_EQ(book.add({.what = 5}).id, 5);
  ASSERT_EQ(book.size(), 4U);
  for (const std::int64_t id : {0, 2, 3, 5}) EXPECT_EQ(book[book.index_of(id)].what, id);
}

TEST(LandmarkBook, GoesOnWhereAnotherRunEnded) {
  LandmarkBook<Entry> book;
  book.restore({.id = 7, .what = 1});
  book.continue_from(12);
  EXPECT_EQ(book.add({.what = 2}).id, 12);
  EXPECT_EQ(book[book.index_of(7)].what, 1);
  EXPECT_EQ(book.next_id(), 13);
}

struct Begun {
  int times = 0;
  bool known = false;
  void operator()(const StartPose& pose) {
    ++times;
    known = pose.known;
  }
};

TEST(MapStartDecision, BeginsAtOnceUnlessTheOdometryIsToSay) {
  const MapSnapshot map;
  Begun begun;
  MapStartDecision beginning;
  beginning.begin({.map = &map, .mode = MapMode::localise, .pose_known = true}, begun);
  EXPECT_EQ(begun.times, 1);
  EXPECT_TRUE(begun.known);
  EXPECT_FALSE(beginning.extends());
  EXPECT_FALSE(beginning.odometry_begins(true, begun)) << "nobody asked";
  EXPECT_EQ(begun.times, 1);
}

TEST(MapStartDecision, WaitsForTheOdometryOnce) {
  const MapSnapshot map;
  for (const bool goes_on : {true, false}) {
    Begun begun;
    MapStartDecision beginning;
    beginning.begin({.map = &map, .asks_odometry = true}, begun);
    EXPECT_EQ(begun.times, 0);
    EXPECT_EQ(beginning.odometry_begins(goes_on, begun), goes_on);
    EXPECT_EQ(begun.times, goes_on ? 0 : 1);
    EXPECT_FALSE(beginning.odometry_begins(goes_on, begun));
    EXPECT_EQ(begun.times, goes_on ? 0 : 1);
  }
}

TEST(RecognitionHistory, AgreementEndsWhatContradictedBefore) {
  RecognitionHistory hearing;
  hearing.path_m = 3.0;
  hearing.contradictions = 4;
  hearing.inflations = 2;
  Evidence evidence = hearing.evidence(Eigen::Matrix3d::Zero(), 5.0);
  EXPECT_EQ(evidence.unrecognised_m, 5.0);
  EXPECT_EQ(evidence.contradictions, 4);
  EXPECT_EQ(evidence.inflations, 2);
  hearing.agreed();
  evidence = hearing.evidence(Eigen::Matrix3d::Zero(), 5.0);
  EXPECT_EQ(evidence.unrecognised_m, 2.0);
  EXPECT_EQ(evidence.contradictions + evidence.inflations, 0);
}

TEST(LostRobot, SaysSoUntilItIsFound) {
  LostRobot robot({});
  EXPECT_FALSE(robot.judgement());
  const ImageAgreement nothing_is_where_it_should_be{.expected = 8, .bearings = 8, .explained = 0, .chance = 0.05};
  bool lost = false;
  for (int i = 0; i < 20 && !lost; ++i) lost = robot.notices(nothing_is_where_it_should_be);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(robot.is_in_doubt());
  ASSERT_TRUE(robot.judgement());
  EXPECT_EQ(robot.judgement()->health, Health::degraded) << "it is not searched for yet";
  const std::vector<KnownLandmark> map(8);
  robot.begin_search(map, {}, {});
  EXPECT_TRUE(robot.is_searched_for());
  EXPECT_FALSE(robot.is_in_doubt());
  EXPECT_EQ(robot.judgement()->health, Health::lost);
  EXPECT_FALSE(robot.nearby({})) << "no place has been suggested";
  robot.was_found();
  EXPECT_FALSE(robot.is_searched_for());
  EXPECT_FALSE(robot.judgement());
}

}  // namespace
}  // namespace azimuth
