#include "settings/configured_estimator.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

MapSnapshot map_of(std::initializer_list<Kind> kinds) {
  MapSnapshot map;
  for (const Kind kind : kinds) map.landmarks.push_back({.id = map.next_id++, .kind = kind});
  return map;
}

/// Unnamed landmarks tell a robot where it is only by their kinds, and only where it may search.
TEST(WhyUnfit, AMapOfUnnamedLandmarksNeedsKindsAndASearchOrAKnownPose) {
  const MapSnapshot alike = map_of({1, 1, 1}), different = map_of({1, 2, 1});
  Configuration configuration;
  configuration.ekf.relocalise = true;
  EXPECT_NE(why_unfit(alike, Rig{}, configuration), "");
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), "");
  configuration.ekf.relocalise = false;
  EXPECT_NE(why_unfit(different, Rig{}, configuration), "");
  configuration.map.pose_known = true;
  EXPECT_EQ(why_unfit(alike, Rig{}, configuration), "");
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), "");
}

}  // namespace
}  // namespace azimuth
