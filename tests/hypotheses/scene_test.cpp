#include "slam/hypotheses/scene.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace azimuth {
namespace {

TEST(Scene, CostsAreLogarithmsOfOdds) {
  Scene scene;
  scene.sigma_bearing_rad = 0.03;
  scene.detection_probability = 0.8;
  scene.clutter_per_rad = 0.5;
  SmootherSettings smoother;
  const HypothesisCosts costs = hypothesis_costs(scene, smoother);
  const double density_at_centre = 1.0 / (std::sqrt(2.0 * std::numbers::pi) * 0.03);
  EXPECT_NEAR(costs.unassigned, std::log(0.8 * density_at_centre / 0.5), 1e-12);
  EXPECT_NEAR(costs.missed, -std::log(0.2), 1e-12);
}

TEST(Scene, SharperBearingsMakeLandmarksDearerAndClutterClearer) {
  Scene sharp, blunt;
  sharp.sigma_bearing_rad = 0.004;
  blunt.sigma_bearing_rad = 0.04;
  const HypothesisCosts of_sharp = hypothesis_costs(sharp, {}), of_blunt = hypothesis_costs(blunt, {});
  EXPECT_GT(of_sharp.unassigned, of_blunt.unassigned);
  EXPECT_GT(of_sharp.landmark, of_blunt.landmark);
}

TEST(Scene, NoCostIsNegativeHoweverMuchClutter) {
  Scene scene;
  scene.clutter_per_rad = 1000.0;
  scene.new_per_rad = 1e6;
  EXPECT_GT(hypothesis_costs(scene, {}).unassigned, 0.0);
  EXPECT_GT(hypothesis_costs(scene, {}).landmark, 0.0);
}

TEST(Scene, ANarrowViewLooksAhead) {
  Scene scene;
  EXPECT_TRUE(scene.in_view(3.0));
  scene.field_of_view_rad = 1.0;
  EXPECT_TRUE(scene.in_view(-0.49));
  EXPECT_FALSE(scene.in_view(0.51));
  EXPECT_TRUE(scene.in_view(2.0 * std::numbers::pi + 0.1));
}

TEST(Scene, TakesMoreImagesToSeeAllTheLessEachShows) {
  Scene scene;
  EXPECT_EQ(scene.images_for_all_round(), 1.0);
  scene.field_of_view_rad = std::numbers::pi / 3.0;
  EXPECT_DOUBLE_EQ(scene.images_for_all_round(), 6.0);
}

}  // namespace
}  // namespace azimuth
