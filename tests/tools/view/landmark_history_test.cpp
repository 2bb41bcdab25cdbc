#include <gmock/gmock.h>
#include <limits>
#include <vector>

#include "tools/view/shown_map.hpp"

namespace azimuth::test {
namespace {

constexpr std::size_t kState = 10, kLastSeen = 9;

std::vector<landmark_t> a_map(std::initializer_list<std::int64_t> ids) {
  std::vector<landmark_t> map;
  for (const std::int64_t id : ids) {
    landmark_t landmark{};
    landmark.id = id;
    landmark.z_m = landmark.sigma_z_m = std::numeric_limits<double>::quiet_NaN();
    map.push_back(landmark);
  }
  return map;
}

std::string state(const LandmarkHistory& history, const std::vector<landmark_t>& map, std::size_t which) {
  return history.json(map)["landmarks"][which][kState];
}

TEST(LandmarkHistory, WhatIsInTheFirstMapMayBeOld) {
  LandmarkHistory history(10);
  history.take_map(a_map({1}), 0.0);
  EXPECT_EQ(state(history, a_map({1}), 0), "confirmed");
}

TEST(LandmarkHistory, OneThatIsContradictedAgainAndAgainIsDoubted) {
  LandmarkHistory history(10);
  history.take_map(a_map({1}), 0.0);
  history.contradicted(1, 1);
  history.contradicted(2, 5);  // the map does not contain this landmark
  EXPECT_EQ(state(history, a_map({1}), 0), "confirmed") << "once may be somebody who stood there";
  history.contradicted(1, 2);
  EXPECT_EQ(state(history, a_map({1}), 0), "doubted");
  history.contradicted(1, 0);
  EXPECT_EQ(state(history, a_map({1}), 0), "confirmed");
}

TEST(LandmarkHistory, ANewOneIsNewForAWhile) {
  LandmarkHistory history(10);
  history.take_map(a_map({1}), 0.0);
  history.take_map(a_map({1, 2}), 10.0);
  EXPECT_EQ(state(history, a_map({1, 2}), 1), "new");
  history.take_map(a_map({1, 2}), 16.0);
  EXPECT_EQ(state(history, a_map({1, 2}), 1), "confirmed");
}

TEST(LandmarkHistory, UnseenIsWhatADrivingRobotDoesNotSee) {
  LandmarkHistory history(10);
  history.take_map(a_map({1, 2}), 0.0);
  history.saw(1, 1.0);
  history.drove(31.0);
  history.saw(2, 32.0);
  history.take_map(a_map({1, 2}), 33.0);
  EXPECT_EQ(state(history, a_map({1, 2}), 0), "unseen");
  EXPECT_EQ(state(history, a_map({1, 2}), 1), "confirmed");
  EXPECT_DOUBLE_EQ(history.json(a_map({1, 2}))["landmarks"][1][kLastSeen], 32.0);
}

TEST(LandmarkHistory, WithoutAWordOnSightingsNothingIsUnseen) {
  LandmarkHistory history(10);
  history.take_map(a_map({1}), 0.0);
  history.drove(1000.0);
  EXPECT_EQ(state(history, a_map({1}), 0), "confirmed");
  EXPECT_TRUE(history.json(a_map({1}))["landmarks"][0][kLastSeen].is_null());
}

TEST(LandmarkHistory, ShowsNoMoreThanItMay) {
  LandmarkHistory history(2);
  const auto map = a_map({1, 2, 3, 4, 5});
  history.take_map(map, 0.0);
  const auto json = history.json(map);
  EXPECT_EQ(json["landmarks"].size(), 2U);
  EXPECT_EQ(json["more"], 3);
}

}  // namespace
}  // namespace azimuth::test
