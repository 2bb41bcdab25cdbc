// What a saved map says of where the robot is.

#include "daemon/saved_map.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

TEST(SavedMapReach, GrowsWithTheAgeOfARecentMap) {
  MapSettings settings;
  settings.recent_s = 20.0;
  settings.fastest_m_per_s = 0.5;
  EXPECT_DOUBLE_EQ(reach_since(0s, settings), 1.0) << "never 0, which is anywhere";
  EXPECT_DOUBLE_EQ(reach_since(10s, settings), 6.0);
  EXPECT_DOUBLE_EQ(reach_since(20s, settings), 11.0);
}

TEST(SavedMapReach, IsAnywhereForAMapThatIsNotRecent) {
  MapSettings settings;
  settings.recent_s = 20.0;
  EXPECT_EQ(reach_since(20'001ms, settings), 0.0);
  EXPECT_EQ(reach_since(-1ms, settings), 0.0) << "of the future: the clock was set";
  settings.recent_s = 0.0;
  EXPECT_EQ(reach_since(0s, settings), 0.0) << "not wanted";
}

TEST(SavedMapReach, LimitsASearchWithinAMinuteUnlessTold) {
  EXPECT_DOUBLE_EQ(reach_since(60s, {}), 151.0);
  EXPECT_EQ(reach_since(61s, {}), 0.0);
}

}  // namespace
}  // namespace azimuth
