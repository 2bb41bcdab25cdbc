#include "settings/configured_estimator.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/camera/model_parameters.hpp"

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
  EXPECT_NE(why_unfit(alike, Rig{}, configuration), std::nullopt);
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), std::nullopt);
  configuration.ekf.relocalisation.lost_log_odds = 0.0;
  EXPECT_NE(why_unfit(different, Rig{}, configuration), std::nullopt);
  configuration.map.pose_known = true;
  EXPECT_EQ(why_unfit(alike, Rig{}, configuration), std::nullopt);
  EXPECT_EQ(why_unfit(different, Rig{}, configuration), std::nullopt);
}

/// The smoother does not search for a robot among landmarks without names.
TEST(EstimatorName, AMapWhoseKindsTellAPlaceIsTheFilters) {
  const MapSnapshot alike = map_of({1, 1, 1}), different = map_of({1, 2, 1});
  Configuration configuration;
  EXPECT_EQ(estimator_name(Rig{}, configuration, &different), "ekf");
  EXPECT_EQ(estimator_name(Rig{}, configuration, &alike), "smoother");
  configuration.map.pose_known = true;
  EXPECT_EQ(estimator_name(Rig{}, configuration, &different), "smoother");
}

/// Ready-made bearings of a camera that looks up are of lamps.
TEST(EstimatorName, EveryFisheyeGetsTheFilterForCeilings) {
  const std::array<std::string_view, 3> fisheyes{"pajdla", "equidistant", "polynomial"};
  for (const ModelRig& model : all_models()) {
    Rig rig;
    rig.camera.model = model;
    const bool is_fisheye = std::ranges::find(fisheyes, name(model)) != fisheyes.end();
    EXPECT_EQ(estimator_name(rig, Configuration{}), is_fisheye ? "lamp_ekf" : "smoother") << name(model);
  }
}

TEST(EstimatorName, APolynomialFisheyeOfARigFileIsOne) {
  const FileResult<Rig> rig = read_rig(
      "front_end = \"bearings\"\n[camera]\nmodel = \"polynomial\"\ncentre_px = [320, 240]\ntheta_max_rad = 1.5\n"
      "polynomial_a0 = -300\npolynomial_a2 = 1e-3\npolynomial_a3 = 0\npolynomial_a4 = 0\n",
      "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(estimator_name(*rig, Configuration{}), "lamp_ekf");
}

}  // namespace
}  // namespace azimuth
