#include <gtest/gtest.h>

#include "slam/perception/lamps/lamp_perception.hpp"
#include "tests/camera/cameras.hpp"

namespace azimuth {
namespace {

/// Centroid and covariance of the image of a ceiling rectangle, one unit above the camera, weighted by image area like
/// a sensor's measurement.
struct Spot {
  Pixel centroid = Pixel::Zero();
  Eigen::Matrix2d spread_px2 = Eigen::Matrix2d::Zero();
};

std::optional<Spot> spot_of(const CameraModel& camera, const Eigen::Vector2d& middle, double length, double width,
                            double turn_rad) {
  constexpr int kSteps = 60;
  const Eigen::Vector2d along{std::cos(turn_rad), std::sin(turn_rad)}, across{-along.y(), along.x()};
  std::vector<std::pair<double, Pixel>> points;
  double total = 0.0;
  for (int k = 0; k < kSteps * kSteps; ++k) {
    const double a = ((k % kSteps + 0.5) / kSteps - 0.5) * length, b = ((k / kSteps + 0.5) / kSteps - 0.5) * width;
    const auto at = [&](double da, double db) -> std::optional<Pixel> {
      const Eigen::Vector2d p = middle + (a + da) * along + (b + db) * across;
      return camera.pixel(Eigen::Vector3d(p.x(), p.y(), 1.0));
    };
    const auto here = at(0, 0), further = at(1e-5, 0), beside = at(0, 1e-5);
    if (!here || !further || !beside) return std::nullopt;
    const Pixel u = *further - *here, v = *beside - *here;
    const double area = std::abs(u.x() * v.y() - u.y() * v.x());
    points.emplace_back(area, *here);
    total += area;
  }
  Spot spot;
  for (const auto& [area, pixel] : points) spot.centroid += area / total * pixel;
  for (const auto& [area, pixel] : points)
    spot.spread_px2 += area / total * (pixel - spot.centroid) * (pixel - spot.centroid).transpose();
  return spot;
}

class CeilingPatchOf : public testing::TestWithParam<test::NamedCamera> {};
INSTANTIATE_TEST_SUITE_P(Cameras, CeilingPatchOf, testing::ValuesIn(test::cameras()),
                         [](const auto& each) { return each.param.name; });

TEST_P(CeilingPatchOf, IsTheLampWhereverItHangs) {
  const CameraModel& camera = GetParam().model;
  int seen = 0;
  double worst_centroid_px = 0.0, worst_middle_px = 0.0;
  for (const double away : {0.3, 0.8, 1.5, 3.0, 5.0}) {
    for (double azimuth_rad = -3.0; azimuth_rad < 3.0; azimuth_rad += 0.7) {
      const Eigen::Vector2d middle = away * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
      const auto spot = spot_of(camera, middle, 0.3, 0.1, 0.9);
      if (!spot || spot->spread_px2.trace() > 40.0 * 40.0) continue;  // half as large as the image
      const auto patch = ceiling_patch(camera, spot->centroid, spot->spread_px2);
      ASSERT_TRUE(patch);
      ++seen;
      const Pixel truth = *camera.pixel(Eigen::Vector3d(middle.x(), middle.y(), 1.0));
      worst_centroid_px = std::max(worst_centroid_px, (spot->centroid - truth).norm());
      worst_middle_px = std::max(worst_middle_px, (patch->middle - truth).norm());
      EXPECT_NEAR(patch->length_heights, 0.3, 0.02);
      EXPECT_NEAR(patch->area_heights2, 0.03, 0.003);
    }
  }
  EXPECT_GT(seen, 10);
  EXPECT_LT(worst_middle_px, 0.2);
  EXPECT_LT(worst_middle_px, 0.2 * worst_centroid_px);
}

TEST_P(CeilingPatchOf, NeedsTheCeiling) {
  const CameraModel& camera = GetParam().model;
  const auto below = camera.pixel(Direction{0.5, std::max(GetParam().lowest_rad, -0.3)});
  ASSERT_TRUE(below);
  if (GetParam().lowest_rad < 0.0) {
    EXPECT_FALSE(ceiling_patch(camera, *below, Eigen::Matrix2d::Identity()));
  }
  if (!camera.direction({1e4, 1e4})) {
    EXPECT_FALSE(ceiling_patch(camera, {1e4, 1e4}, Eigen::Matrix2d::Identity())) << "outside of the image";
  }
}

TEST(CeilingPatch, WorksStraightUp) {
  const CameraModel camera({{511.5, 383.25}, 1.0, -1, -kPi / 2}, test::kEquidistant);
  const auto patch = ceiling_patch(camera, {511.5, 383.25}, Eigen::Matrix2d{{100.0, 0.0}, {0.0, 25.0}});
  ASSERT_TRUE(patch);
  EXPECT_LT((patch->middle - Pixel(511.5, 383.25)).norm(), 1e-6);
  EXPECT_NEAR(patch->length_heights, std::sqrt(12.0 * 100.0) / 237.85, 0.01);
}

}  // namespace
}  // namespace azimuth
