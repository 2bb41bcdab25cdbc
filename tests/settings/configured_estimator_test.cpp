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
  configuration.ekf.relocalisation.lost_log_odds = 10.0;
  EXPECT_NE(why_unfit(alike, Rig{}, configuration), "");
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), "");
  configuration.ekf.relocalisation.lost_log_odds = 0.0;
  EXPECT_NE(why_unfit(different, Rig{}, configuration), "");
  configuration.map.pose_known = true;
  EXPECT_EQ(why_unfit(alike, Rig{}, configuration), "");
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), "");
}

/// Ready-made bearings of a camera that looks up are of lamps.
TEST(EstimatorName, EveryFisheyeGetsTheFilterForCeilings) {
  Rig rig;
  for (const std::string_view model : {"pajdla", "equidistant", "polynomial"}) {
    rig.camera.model = model;
    EXPECT_EQ(estimator_name(rig, Configuration{}), "lamp_ekf") << model;
  }
  for (const std::string_view model : {"bearings", "radial", "hyperbolic_mirror", "parabolic_mirror"}) {
    rig.camera.model = model;
    EXPECT_EQ(estimator_name(rig, Configuration{}), "ekf") << model;
  }
}

}  // namespace
}  // namespace azimuth
