#include "slam/camera/image_axes.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

TEST(ImageAxes, HeadingUpInTheImageAzimuthToTheLeft) {
  const ImageAxes axes{{512, 384}, 1.0, -1, -kPi / 2};
  EXPECT_NEAR(axes.azimuth_rad({512, 284}), 0.0, 1e-15) << "above the centre: ahead";
  EXPECT_NEAR(axes.azimuth_rad({412, 384}), kPi / 2, 1e-15) << "to the left: left";
  EXPECT_NEAR(axes.azimuth_rad({612, 384}), -kPi / 2, 1e-15);
  EXPECT_NEAR(axes.azimuth_rad({512.0, 484}), -kPi, 1e-15) << "below: behind, at the lower end of the range";
}

TEST(ImageAxes, BetaStretchesRows) {
  const ImageAxes axes{{100, 50}, 2.0, 1, 0.0};
  const PolarPixel below = axes.polar({100, 2.0 * (50 + 30)});
  EXPECT_NEAR(below.radius_px, 30, 1e-12);
  EXPECT_NEAR(below.azimuth_rad, kPi / 2, 1e-15);
}

TEST(ImageAxes, PolarAndBack) {
  for (const int direction : {-1, 1}) {
    const ImageAxes axes{{319.5, 243.25}, 0.9, direction, 2.5};
    for (double u = 0; u < 640; u += 31) {
      for (double v = 0; v < 480; v += 29) {
        EXPECT_NEAR((axes.pixel(axes.polar({u, v})) - Pixel(u, v)).norm(), 0.0, 1e-10);
      }
    }
  }
}

TEST(ImageAxes, AzimuthIgnoresRadialDistortion) {
  const ImageAxes axes{{320, 240}, 1.1, -1, 0.3};
  const double azimuth = axes.azimuth_rad(axes.pixel({10.0, 1.0}));
  for (const double radius_px : {20.0, 77.0, 300.0}) {
    EXPECT_NEAR(axes.azimuth_rad(axes.pixel({radius_px, 1.0})), azimuth, 1e-14);
  }
}

TEST(ImageAxes, NearTheCentreTheJacobianStaysFinite) {
  const ImageAxes axes{{320, 240}};
  for (const double radius_px : {0.0, 1e-12, 0.5, 1.999}) {
    const Eigen::Matrix2d jacobian = axes.polar_jacobian(axes.pixel({radius_px, 0.7}));
    EXPECT_NEAR(jacobian.row(0).norm(), 1 / ImageAxes::kNearCentre_px, 1e-12);
    EXPECT_NEAR(jacobian.row(1).norm(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace azimuth
