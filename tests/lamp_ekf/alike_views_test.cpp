// Sightings that share an error.

#include "slam/estimator/alike_views.hpp"

#include <gtest/gtest.h>

#include "slam/ekf/curvature.hpp"

namespace azimuth {
namespace {

Eigen::Vector3d at_zenith_angle(double angle_rad) { return {std::sin(angle_rad), 0.0, std::cos(angle_rad)}; }

TEST(AlikeViews, CountSightingsInARowUntilTheViewIsAnother) {
  AlikeViews views;
  EXPECT_EQ(views.add(at_zenith_angle(0.0)), 1);
  EXPECT_EQ(views.add(at_zenith_angle(0.2)), 2);
  EXPECT_EQ(views.add(at_zenith_angle(0.4)), 3);
  EXPECT_EQ(views.add(at_zenith_angle(0.6)), 1) << "although the last one was near";
  EXPECT_EQ(views.add(at_zenith_angle(0.2)), 2);
  EXPECT_EQ(views.add(at_zenith_angle(0.0)), 1);
  for (int i = 0; i < 100; ++i) views.add(at_zenith_angle(0.0));
  EXPECT_EQ(views.add(at_zenith_angle(0.0)), AlikeViews::kMost);
}

TEST(SharedErrors, AreNeverAveragedAway) {
  const double own = 4.0, shared = 0.5;
  double information = 0.0;
  for (int k = 1; k <= 50; ++k) {
    information += 1.0 / variance_of_next(own, shared, k);
    EXPECT_NEAR(1.0 / information, shared + own / k, 1e-12);
  }
  EXPECT_EQ(variance_of_next(own, 0.0, 7), own);
  EXPECT_EQ(variance_of_next(0.0, 0.0, 2), 0.0);
}

}  // namespace
}  // namespace azimuth
