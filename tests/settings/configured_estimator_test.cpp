#include "settings/configured_estimator.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/camera/camera_rig.hpp"

namespace azimuth {
namespace {

MapSnapshot map_of(std::initializer_list<Kind> kinds) {
  MapSnapshot map;
  for (const Kind kind : kinds) map.landmarks.push_back({.id = map.next_id++, .kind = kind});
  return map;
}

/// Landmarks without names determine a robot's pose only by their kinds, and only if relocalisation is enabled.
TEST(WhyUnfit, AMapOfUnnamedLandmarksNeedsKindsAndASearchOrAKnownPose) {
  const MapSnapshot alike = map_of({1, 1, 1}), different = map_of({1, 2, 1});
  Configuration configuration;
  configuration.relocalisation.lost_log_odds = 10.0;
  EXPECT_NE(why_unfit(alike, Rig{}, configuration), std::nullopt);
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), std::nullopt);
  configuration.relocalisation.lost_log_odds = 0.0;
  EXPECT_NE(why_unfit(different, Rig{}, configuration), std::nullopt);
  configuration.map.pose_known = true;
  EXPECT_EQ(why_unfit(alike, Rig{}, configuration), std::nullopt);
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), std::nullopt);
}

/// The smoother does not relocalise among landmarks without names.
TEST(ChosenEstimator, AMapWhoseKindsTellAPlaceIsTheFilters) {
  const MapSnapshot alike = map_of({1, 1, 1}), different = map_of({1, 2, 1});
  Configuration configuration;
  EXPECT_EQ(chosen_estimator(Rig{}, configuration, &different), EstimatorKind::ekf);
  EXPECT_EQ(chosen_estimator(Rig{}, configuration, &alike), EstimatorKind::smoother);
  configuration.map.pose_known = true;
  EXPECT_EQ(chosen_estimator(Rig{}, configuration, &different), EstimatorKind::smoother);
}

/// Bearings from an external detector with an upward camera belong to lamps.
TEST(ChosenEstimator, EveryFisheyeGetsTheFilterForCeilings) {
  const std::array<std::string_view, 3> fisheyes{"pajdla", "equidistant", "polynomial"};
  for (const ModelRig& model : all_models()) {
    Rig rig;
    rig.camera.model = model;
    const bool is_fisheye = std::ranges::find(fisheyes, name(model)) != fisheyes.end();
    EXPECT_EQ(chosen_estimator(rig, Configuration{}), is_fisheye ? EstimatorKind::lamp_ekf : EstimatorKind::smoother)
        << name(model);
  }
}

TEST(ChosenEstimator, APolynomialFisheyeOfARigFileIsOne) {
  const FileResult<Rig> rig = read_rig(
      "front_end = \"bearings\"\n[camera]\nmodel = \"polynomial\"\ncentre_px = [320, 240]\ntheta_max_rad = 1.5\n"
      "polynomial_a0 = -300\npolynomial_a2 = 1e-3\npolynomial_a3 = 0\npolynomial_a4 = 0\n",
      "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(chosen_estimator(*rig, Configuration{}), EstimatorKind::lamp_ekf);
}

}  // namespace
}  // namespace azimuth
