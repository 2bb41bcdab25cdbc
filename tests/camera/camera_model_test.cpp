#include "slam/camera/camera_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <gmock/gmock.h>

#include "tests/camera/cameras.hpp"

namespace azimuth {
namespace {

using test::NamedCamera;

class EveryCamera : public ::testing::TestWithParam<NamedCamera> {
 protected:
  const NamedCamera& camera() const { return GetParam(); }
  const CameraModel& model() const { return GetParam().model; }
};
INSTANTIATE_TEST_SUITE_P(Cameras, EveryCamera, ::testing::ValuesIn(test::cameras()),
                         [](const auto& each) { return each.param.name; });

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST_P(EveryCamera, PixelsComeBackOverTheWholeImage) {
  int seen = 0;
  for (double v = 0; v < camera().height_px; v += 3.7) {
    for (double u = 0; u < camera().width_px; u += 3.3) {
      const Pixel pixel{u, v};
      const auto ray = model().ray(pixel);
      if (!ray) continue;
      ++seen;
      ASSERT_NEAR(ray->norm(), 1.0, 1e-14);
      const auto again = model().pixel(*ray);
      ASSERT_TRUE(again) << pixel.transpose();
      ASSERT_NEAR((*again - pixel).norm(), 0.0, 1e-9) << pixel.transpose();
    }
  }
  EXPECT_GT(seen, 10'000);
}

TEST_P(EveryCamera, DirectionsComeBackOverAllThatIsSeen) {
  for (double elevation = camera().lowest_rad + 1e-6; elevation <= camera().highest_rad - 1e-6; elevation += 0.013) {
    for (double azimuth = -kPi; azimuth < kPi; azimuth += 0.037) {
      const Eigen::Vector3d sent = ray(Direction{azimuth, elevation});
      const auto pixel = model().pixel(Eigen::Vector3d(2.5 * sent));
      ASSERT_TRUE(pixel) << azimuth << ' ' << elevation;
      const auto back = model().direction(*pixel);
      ASSERT_TRUE(back);
      ASSERT_NEAR(angle_between(ray(*back), sent), 0.0, 1e-10);
      ASSERT_GE(back->azimuth_rad, -kPi);
      ASSERT_LT(back->azimuth_rad, kPi);
    }
  }
}

TEST_P(EveryCamera, JacobianIsTheDerivative) {
  int checked = 0;
  for (double v = 1; v < camera().height_px; v += 17.3) {
    for (double u = 1; u < camera().width_px; u += 19.1) {
      const Pixel pixel{u, v};
      if (model().axes().polar(pixel).radius_px >= ImageAxes::kNearCentre_px)
        checked += test::expect_jacobian_is_derivative(model(), pixel);
    }
  }
  EXPECT_GT(checked, 500);
}

TEST_P(EveryCamera, CentreLooksAlongTheAxisAndItsAzimuthIsUncertain) {
  const ImageAxes& axes = model().axes();
  const Pixel centre = axes.pixel({0.0, 0.0});
  const auto ray = model().ray(centre);
  ASSERT_TRUE(ray);
  EXPECT_NEAR(std::abs(ray->z()), 1.0, 1e-12);
  const auto covariance = model().direction_covariance(centre, 1.5);
  ASSERT_TRUE(covariance);
  EXPECT_TRUE(covariance->allFinite());
  // The azimuth is as uncertain as at the radius kNearCentre_px, and less uncertain farther out.
  const double sigma_azimuth = std::sqrt((*covariance)(0, 0));
  EXPECT_GE(sigma_azimuth, 0.99 * 1.5 / ImageAxes::kNearCentre_px);
  const auto farther = model().direction_covariance(centre + Pixel{40.0, 0.0}, 1.5);
  ASSERT_TRUE(farther);
  EXPECT_LT((*farther)(0, 0), 0.01 * (*covariance)(0, 0));
}

TEST_P(EveryCamera, CovarianceIsThatOfSquarePixelsFarOut) {
  if (model().axes().beta != 1.0) return;
  const Pixel pixel = model().axes().pixel({100.0, 0.8});
  const auto covariance = model().direction_covariance(pixel, 2.0);
  ASSERT_TRUE(covariance);
  EXPECT_NEAR(std::sqrt((*covariance)(0, 0)), 2.0 / 100.0, 1e-12) << "sigma / r";
  EXPECT_NEAR((*covariance)(0, 1), 0.0, 1e-12);
}

TEST_P(EveryCamera, AzimuthGoesTheWayItIsSaid) {
  const ImageAxes& axes = model().axes();
  const Pixel right = axes.pixel({0, 0}) + Pixel{50.0, 0.0};
  ASSERT_TRUE(model().direction(right));
  EXPECT_NEAR(model().direction(right)->azimuth_rad, axes.azimuth_offset_rad, 1e-12);
  const Pixel below = axes.pixel({0, 0}) + Pixel{0.0, 50.0};
  EXPECT_NEAR(wrap(model().direction(below)->azimuth_rad - axes.azimuth_offset_rad), axes.azimuth_direction * kPi / 2,
              1e-12);
}

TEST_P(EveryCamera, WhatCannotBeSeenHasNoPixel) {
  for (const double elevation : {camera().lowest_rad - 0.1, camera().highest_rad + 0.4}) {
    if (std::abs(elevation) > kPi / 2) continue;
    EXPECT_FALSE(model().pixel(Direction{0.3, elevation})) << elevation;
  }
  EXPECT_FALSE(model().pixel(Direction{0.0, std::nan("")}));
  EXPECT_FALSE(model().direction({std::nan(""), 1.0}));
}

TEST(CameraModel, ParametersThatMakeNoCamera) {
  const ImageAxes good{{320, 240}};
  EXPECT_EQ(CameraModel::problem(good, test::kPajdla), std::nullopt);
  const auto refused = [&](const RadialProfile& profile) { return CameraModel::problem(good, profile).has_value(); };
  EXPECT_TRUE(refused(HyperbolicMirror{0.0, 23.0, 1000.0}));
  EXPECT_TRUE(refused(HyperbolicMirror{28.0, 23.0, -1.0}));
  EXPECT_TRUE(refused(HyperbolicMirror{28.0, INFINITY, 1000.0}));
  EXPECT_TRUE(refused(ParabolicMirror{0.0}));
  EXPECT_TRUE(refused(EquidistantFisheye{200.0, 4.0}));
  EXPECT_TRUE(refused(EquidistantFisheye{NAN, 1.0}));
  EXPECT_TRUE(refused(PajdlaFisheye{180.0, 2.0, 60.0, 1.2, 0.0}));
  EXPECT_TRUE(refused(PajdlaFisheye{180.0, 1.0, 60.0, 1.2, 1.6})) << "the tangent's pole";
  EXPECT_TRUE(refused(PajdlaFisheye{10.0, 2.0, 200.0, 0.7, 1.5})) << "the sine turns back";
  EXPECT_TRUE(refused(PajdlaFisheye{180.0, 2.0, NAN, 1.2, 1.5}));

  for (const ImageAxes& bad :
       {ImageAxes{{NAN, 0}}, ImageAxes{{0, 0}, 0.0}, ImageAxes{{0, 0}, 1.0, 2}, ImageAxes{{0, 0}, 1.0, 1, INFINITY}}) {
    EXPECT_TRUE(CameraModel::problem(bad, test::kPajdla));
  }
}

TEST(Direction, RaysPointWhereTheySay) {
  EXPECT_NEAR((ray({0, 0}) - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((ray({kPi / 2, 0}) - Eigen::Vector3d(0, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((ray({1.0, kPi / 2}) - Eigen::Vector3d(0, 0, 1)).norm(), 0, 1e-15);
  const Direction back = direction(Eigen::Vector3d(-2, 0, -2));
  EXPECT_EQ(back.azimuth_rad, -kPi);
  EXPECT_NEAR(back.elevation_rad, -kPi / 4, 1e-15);
}

}  // namespace
}  // namespace azimuth
