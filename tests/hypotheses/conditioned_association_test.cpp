#include "slam/hypotheses/conditioned_association.hpp"

#include <gmock/gmock.h>

#include "tests/hypotheses/known_but_for_heading.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;

/// Landmarks are known well; the heading has the standard deviation `sigma_heading_rad`.
PoseAndLandmarks seen_under(const std::vector<double>& azimuths, double sigma_heading_rad) {
  return known_but_for_heading(azimuths, sigma_heading_rad, 1e-6);
}

ConditionedAssociationSettings settings() {
  ConditionedAssociationSettings settings;
  settings.scene.detection_probability = 0.9;
  settings.scene.new_per_rad = 0.4;
  settings.min_margin = 2.0;
  return settings;
}

constexpr double kTurned_rad = 0.2;  // a turn that odometry does not measure
NamelessSighting at(double azimuth_rad) { return {azimuth_rad - kTurned_rad, 0.02}; }

TEST(ConditionedAssociation, AClearPairTellsThoseApartThatWereNot) {
  // The last two landmarks are 0.3 rad apart, and the last one's bearing is nearer to the other landmark.
  const PoseAndLandmarks belief = seen_under({-2.0, 1.0, 1.3}, 0.15);
  EXPECT_THAT(associate_conditioned(belief, std::vector{at(1.3)}, settings()), ElementsAre(-1));
  EXPECT_THAT(associate_conditioned(belief, std::vector{at(1.3), at(1.0), at(-2.0)}, settings()), ElementsAre(2, 1, 0));
}

TEST(ConditionedAssociation, WhatLiesBetweenTwoIsOfNeither) {
  const PoseAndLandmarks belief = seen_under({1.0, 1.06}, 1e-3);
  EXPECT_THAT(associate_conditioned(belief, std::vector{NamelessSighting{1.03, 0.02}}, settings()), ElementsAre(-1));
}

TEST(ConditionedAssociation, ALandmarkOutOfRangeIsNotAskedAfter) {
  const PoseAndLandmarks belief = seen_under({1.0}, 1e-3);
  ConditionedAssociationSettings near = settings();
  EXPECT_THAT(associate_conditioned(belief, std::vector{NamelessSighting{1.0, 0.02}}, near), ElementsAre(0));
  near.scene.range_m = 3.0 / (1.0 + near.scene.range_doubt);
  EXPECT_THAT(associate_conditioned(belief, std::vector{NamelessSighting{1.0, 0.02}}, near), ElementsAre(-1));
}

}  // namespace
}  // namespace azimuth
