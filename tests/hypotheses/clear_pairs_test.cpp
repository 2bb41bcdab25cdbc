#include "slam/hypotheses/clear_pairs.hpp"

#include <gmock/gmock.h>

namespace azimuth {
namespace {

using testing::ElementsAre;

constexpr double kAlone = 4.0, kDearest = 3.7, kGap = 1.5;

std::vector<LandmarkId> clear(const std::vector<CostlyPair>& pairs) {
  return clear_pairs(pairs, 10, 2, {kAlone, kDearest, kGap});
}

TEST(ClearPairs, CheapestFirstOneToOne) {
  EXPECT_THAT(clear({{0.1, 10, 7}, {2.0, 11, 7}}), ElementsAre(7, kOfNothing));
}

TEST(ClearPairs, WhatLiesBetweenTwoFreeLandmarksIsOfNeither) {
  EXPECT_THAT(clear({{0.5, 10, 7}, {1.0, 10, 8}}), ElementsAre(kOfNothing, kOfNothing));
}

TEST(ClearPairs, ARivalThatIsTakenCountsWithWhatItWouldCostToTakeItAway) {
  // Each bearing is near both landmarks, but only one assignment has a low cost.
  EXPECT_THAT(clear({{0.1, 10, 7}, {0.2, 11, 8}, {1.2, 10, 8}, {1.3, 11, 7}}), ElementsAre(7, 8));
  // The swapped assignment costs as little, so neither is clear.
  EXPECT_THAT(clear({{0.1, 10, 7}, {0.2, 11, 8}, {0.3, 10, 8}, {0.4, 11, 7}}), ElementsAre(kOfNothing, kOfNothing));
}

TEST(ClearPairs, WhatIsTooDearIsOfNothing) { EXPECT_THAT(clear({{3.8, 10, 7}}), ElementsAre(kOfNothing, kOfNothing)); }

}  // namespace
}  // namespace azimuth
