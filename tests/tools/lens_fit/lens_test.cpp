#include "tools/lens_fit/lens.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "slam/camera/make_camera.hpp"
#include "tests/tools/lens_fit/simulated_lens_drive.hpp"

namespace azimuth {
namespace {

constexpr double kStep = 1e-6;

class LensJacobians : public testing::TestWithParam<double> {};

TEST_P(LensJacobians, AreThoseOfDifferences) {
  Lens lens = test::known_lens();
  lens.axes.beta = 1.02;
  lens.tilt = {.roll_rad = 0.04, .pitch_rad = -0.07};
  for (const double azimuth : {0.0, 0.7, 2.5, -1.9}) {
    const double theta = GetParam(), height_m = 4.7;
    const Eigen::Vector3d point =
        height_m * Eigen::Vector3d(std::tan(theta) * std::cos(azimuth), std::tan(theta) * std::sin(azimuth), 1.0);
    const double about_px = 240.0 * theta;
    const auto at = lens.image(point, about_px);
    ASSERT_TRUE(at);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d off = kStep * Eigen::Vector3d::Unit(k);
      const Eigen::Vector2d slope =
          (lens.image(point + off, about_px)->pixel - lens.image(point - off, about_px)->pixel) / (2.0 * kStep);
      EXPECT_LT((at->by_point.col(k) - slope).norm(), 1e-5) << k;
    }
    for (int k = 0; k < kLensNumbers; ++k) {
      const LensVector off = kStep * LensVector::Unit(k);
      const Eigen::Vector2d slope =
          (lens.moved(off).image(point, about_px)->pixel - lens.moved(-off).image(point, about_px)->pixel) /
          (2.0 * kStep);
      EXPECT_LT((at->by_lens.col(k) - slope).norm(), 1e-4) << k;
    }
    for (int k = 0; k < 2; ++k) {
      const auto pixel_tilted = [&](double by_rad) {
        Lens other = lens;
        (k == 0 ? other.tilt.roll_rad : other.tilt.pitch_rad) += by_rad;
        return other.image(point, about_px)->pixel;
      };
      const Eigen::Vector2d slope = (pixel_tilted(kStep) - pixel_tilted(-kStep)) / (2.0 * kStep);
      EXPECT_LT((at->by_tilt.col(k) - slope).norm(), 1e-4) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(FromTheAxis, LensJacobians, testing::Values(1e-4, 0.2, 0.9, 1.4),
                         [](const auto& use) { return std::to_string(static_cast<int>(1e4 * use.param)); });

TEST(Lens, IsTheCameraThatItsRigDescribes) {
  Lens lens = test::known_lens();
  lens.tilt = {.roll_rad = 0.04, .pitch_rad = -0.07};
  CameraRig rig;
  rig.image.width_px = rig.image.height_px = 768;
  std::string problem;
  const auto camera = camera_of(with_lens(rig, lens, 1.3), problem);
  ASSERT_TRUE(camera) << problem;
  const Eigen::Vector3d point(1.3, -2.1, 3.0);
  EXPECT_LT((*camera->pixel(point) - lens.image(point, 150.0)->pixel).norm(), 1e-9);
  const auto again = lens_of(with_lens(rig, lens, 1.3), lens.radius_px, problem);
  ASSERT_TRUE(again) << problem;
  EXPECT_LT((again->image(point, 150.0)->pixel - lens.image(point, 150.0)->pixel).norm(), 1e-6);
}

TEST(Lens, WithAllHeightsDoubledHasTheSameImages) {
  const Lens lens = test::known_lens();
  Lens longer = lens;
  for (double& each : longer.c) each *= 2.0;
  const Eigen::Vector3d point(1.3, -2.1, 3.0), higher(1.3, -2.1, 6.0);
  EXPECT_LT((longer.image(higher, 150.0)->pixel - lens.image(point, 150.0)->pixel).norm(), 1e-9);
}

TEST(Lens, LooksWhereItsImagesAre) {
  Lens lens = test::known_lens();
  lens.tilt = {.roll_rad = 0.04, .pitch_rad = -0.07};
  const Eigen::Vector3d point(1.3, -2.1, 3.0);
  const auto there = lens.on_plane(lens.image(point, 150.0)->pixel, 3.0);
  ASSERT_TRUE(there);
  EXPECT_LT((*there - point.head<2>()).norm(), 1e-9);
}

}  // namespace
}  // namespace azimuth
