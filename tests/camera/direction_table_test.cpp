#include "slam/camera/direction_table.hpp"

#include <gtest/gtest.h>

#include "tests/camera/cameras.hpp"

namespace azimuth {
namespace {

constexpr int kWidth_px = 320, kHeight_px = 260;

/// Cameras of a quarter of the usual size, so that their tables are small.
std::vector<test::NamedCamera> small_cameras() {
  const ImageAxes square{{159.5, 129.25}, 1.0, -1, -kPi / 2};
  const ImageAxes flat{{160.0, 135.0}, 0.93, 1, 0.4};
  return {{"hyperbolic", {square, HyperbolicMirror{28.095, 23.4125, 300.0}}, kWidth_px, kHeight_px, -kPi / 2, 0.85},
          {"pajdla", {flat, PajdlaFisheye{45.0, 2.0, 15.0, 1.2, 1.6}}, kWidth_px, kHeight_px, -0.029, kPi / 2},
          {"equidistant", {square, EquidistantFisheye{60.0, 1.5}}, kWidth_px, kHeight_px, 0.071, kPi / 2}};
}

class DirectionTableOf : public testing::TestWithParam<test::NamedCamera> {};
INSTANTIATE_TEST_SUITE_P(Cameras, DirectionTableOf, testing::ValuesIn(small_cameras()),
                         [](const auto& each) { return each.param.name; });

TEST_P(DirectionTableOf, SkipsNoPixelAndHoldsItsDirection) {
  const CameraModel& camera = GetParam().model;
  const DirectionTable table(camera, kWidth_px, kHeight_px);
  int seen = 0;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const auto exact = camera.direction({u, v});
      if (!exact || exact->elevation_rad > GetParam().highest_rad ||
          exact->elevation_rad < GetParam().lowest_rad + 0.02)
        continue;  // the rim cuts these pixels
      const auto cell = table.at({u, v});
      ASSERT_TRUE(cell) << u << ", " << v;
      ++seen;
      if (camera.axes().polar({u, v}).radius_px < 4.0) continue;
      EXPECT_LE(std::abs(wrap(cell->middle.azimuth_rad - exact->azimuth_rad)), cell->half_rad.x() + 1e-6);
      EXPECT_LE(std::abs(cell->middle.elevation_rad - exact->elevation_rad), cell->half_rad.y() + 1e-6);
    }
  }
  EXPECT_GT(seen, kWidth_px * kHeight_px / 10);
}

TEST_P(DirectionTableOf, IsAsWideAsAPixel) {
  const CameraModel& camera = GetParam().model;
  const DirectionTable table(camera, kWidth_px, kHeight_px);
  for (int v = 2; v < kHeight_px; v += 9) {
    for (int u = 3; u < kWidth_px; u += 7) {
      const Pixel pixel(u, v);
      const auto jacobian = camera.direction_jacobian(pixel);
      const double radius_px = camera.axes().polar(pixel).radius_px;
      const auto exact = camera.direction(pixel);
      if (!exact || radius_px < 10.0 || exact->elevation_rad > GetParam().highest_rad - 0.1 ||
          exact->elevation_rad < GetParam().lowest_rad + 0.1)
        continue;
      // Half a pixel along each axis; the sum is reached at the pixel's corners.
      const Eigen::Vector2d expected_rad = 0.5 * jacobian->cwiseAbs().rowwise().sum();
      const Eigen::Vector2d half_rad = table.at(pixel)->half_rad;
      for (const int k : {0, 1}) {
        EXPECT_LT(half_rad[k], 1.15 * expected_rad[k]) << u << ", " << v << ": " << k;
        EXPECT_GT(half_rad[k], 0.5 * expected_rad[k]) << u << ", " << v << ": " << k;
      }
    }
  }
}

TEST(DirectionTable, AzimuthsAreCircular) {
  const CameraModel camera({{80.0, 80.0}, 1.0, -1, -kPi / 2}, EquidistantFisheye{60.0, 1.3});
  const DirectionTable table(camera, 161, 161);
  for (int v = 100; v < 150; ++v) {  // behind the robot the azimuth wraps from pi to -pi
    const auto cell = table.at({80, v});
    ASSERT_TRUE(cell);
    EXPECT_LT(std::abs(wrap(cell->middle.azimuth_rad - kPi)), 1e-2);
    EXPECT_LT(cell->half_rad.x(), 0.04);
  }
  EXPECT_GT(table.at({80, 80})->half_rad.x(), 2.5) << "the centre has all of them";
  EXPECT_FALSE(table.at({0, 0})) << "beyond the lens's circle";
  EXPECT_FALSE(table.at({-1, 80}));
  EXPECT_FALSE(table.at({80, 161}));
  EXPECT_FALSE(table.at({std::nan(""), 80}));
}

}  // namespace
}  // namespace azimuth
