// Tests how the view shows the bearings that the daemon expected in its images.

#include <gtest/gtest.h>

#include "tests/tools/view/shown.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

using LiveExpectations = ShownTest;

TEST_F(LiveExpectations, BearingsComeWithWhatWasExpectedOfTheirImage) {
  view_.take_bearings(a_set(0, {0.2}), now());
  view_.take_expectations(expectations(0, {{7, 0.2}}), now());
  view_.take_sightings(sightings(0, 1, {{7, 0.2}}), now());
  const auto bearings = of_kind(EventKind::bearings);
  ASSERT_EQ(bearings.size(), 1U);
  EXPECT_EQ(bearings[0]["expected"], nlohmann::json::parse("[[7, 0.2, 0.1, null, 0.3]]"));
  pass(100ms);
  view_.take_bearings(a_set(100, {0.2}), now());
  pass(200ms);
  view_.turn(now(), "");
  EXPECT_TRUE(of_kind(EventKind::bearings).back()["expected"].empty()) << "of another image";
}

TEST_F(LiveExpectations, WhatIsExpectedIsInTheRobotsFrameToo) {
  view_.take_rig(kRig, now());
  view_.take_expectations(expectations(0, {{7, -0.1}}), now());
  view_.take_bearings(a_set(0, {0.1}), now());
  pass(200ms);
  view_.turn(now(), "");
  const auto shown = of_kind(EventKind::bearings).at(0);
  EXPECT_NEAR(shown["expected"][0][1], shown["bearings"][0][0], 1e-5) << "of a camera that counts clockwise";
}

TEST_F(LiveExpectations, HonestyIsThatOfAllBearingsSinceTheLastStatus) {
  expectations_t message = expectations(0, {{7, 0.2}});
  message.nis = 2.5;
  message.compared = 3;
  view_.take_expectations(message, now());
  message.utime += 100'000;
  view_.take_expectations(message, now());
  view_.take_status(status_t{}, now());
  view_.take_status(status_t{}, now());
  const auto shown = of_kind(EventKind::status);
  EXPECT_EQ(shown[0]["nis"], nlohmann::json::parse(R"({"value": 5.0, "degrees": 6})"));
  EXPECT_TRUE(shown[1]["nis"].is_null()) << "nothing was used since";
}

TEST_F(LiveExpectations, ALandmarkWhoseBearingsAreRefusedIsDoubted) {
  view_.take_map(a_map_piece(0, 1, 1), now());
  expectations_t message = expectations(0, {{0, 0.2}});
  message.expected[0].rejected_in_row = 3;
  view_.take_expectations(message, now());
  view_.take_map(a_map_piece(0, 1, 2), now());
  EXPECT_EQ(of_kind(EventKind::map).back()["landmarks"][0][10], "doubted");
}

}  // namespace
}  // namespace azimuth::test
