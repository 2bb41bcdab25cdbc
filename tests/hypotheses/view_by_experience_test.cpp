#include "slam/hypotheses/view_by_experience.hpp"

#include <gtest/gtest.h>
#include <numbers>

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

}  // namespace
}  // namespace azimuth
