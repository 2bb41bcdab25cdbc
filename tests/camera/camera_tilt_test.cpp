// Cameras with a tilted axis: every kind of camera, tilted in both directions.

#include "slam/camera/camera_tilt.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <ostream>
#include <tuple>

#include "slam/camera/direction_table.hpp"
#include "tests/camera/cameras.hpp"

namespace azimuth {

void PrintTo(const CameraTilt& tilt, std::ostream* out) { *out << tilt.roll_rad << ", " << tilt.pitch_rad; }

namespace {

using test::NamedCamera;

class TiltedCamera : public testing::TestWithParam<std::tuple<NamedCamera, CameraTilt>> {
 protected:
  const NamedCamera& camera() const { return std::get<0>(GetParam()); }
  const CameraTilt& tilt() const { return std::get<1>(GetParam()); }
  const CameraModel& upright() const { return camera().model; }
  CameraModel model() const { return {upright().axes(), upright().profile(), tilt()}; }

  /// Calls check(pixel) for pixels spread over the camera's field of view.
  template <class Check>
  void over_the_image(const Check& check) const {
    int seen = 0;
    for (double v = 1; v < camera().height_px; v += 13.7) {
      for (double u = 1; u < camera().width_px; u += 11.3) {
        if (!upright().direction({u, v})) continue;
        ++seen;
        ASSERT_NO_FATAL_FAILURE(check(Pixel(u, v)));
      }
    }
    EXPECT_GT(seen, 500);
  }
};
INSTANTIATE_TEST_SUITE_P(Cameras, TiltedCamera,
                         testing::Combine(testing::ValuesIn(test::cameras()),
                                          testing::Values(CameraTilt{0.035, 0.0}, CameraTilt{0.0, -0.0175},
                                                          CameraTilt{-0.2, 0.3})),
                         [](const auto& each) {
                           const CameraTilt& tilt = std::get<1>(each.param);
                           return std::get<0>(each.param).name + (tilt.roll_rad == 0.0    ? "_pitch"
                                                                  : tilt.pitch_rad == 0.0 ? "_roll"
                                                                                          : "_both");
                         });

TEST_P(TiltedCamera, SeesWhatTheUprightOneSeesTurned) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(tilt().pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() *
                            Eigen::AngleAxisd(tilt().roll_rad, Eigen::Vector3d::UnitX()).toRotationMatrix();
  over_the_image([&](const Pixel& pixel) {
    ASSERT_NEAR((*model().ray(pixel) - R * *upright().ray(pixel)).norm(), 0.0, 1e-12) << pixel.transpose();
  });
}

TEST_P(TiltedCamera, PixelsComeBack) {
  over_the_image([&](const Pixel& pixel) {
    const auto by_direction = model().pixel(*model().direction(pixel)), by_ray = model().pixel(*model().ray(pixel));
    ASSERT_TRUE(by_direction && by_ray) << pixel.transpose();
    ASSERT_NEAR((*by_direction - pixel).norm(), 0.0, 1e-8) << pixel.transpose();
    ASSERT_NEAR((*by_ray - pixel).norm(), 0.0, 1e-8) << pixel.transpose();
  });
}

/// The upright camera sees the direction at the levelled pixel.
TEST_P(TiltedCamera, LevelledPixelsAreThoseOfTheUprightCamera) {
  int levelled = 0;
  over_the_image([&](const Pixel& pixel) {
    const auto level = model().level_pixel(pixel);
    if (!level) return;  // outside the upright camera's field of view
    ++levelled;
    ASSERT_NEAR((*upright().ray(*level) - *model().ray(pixel)).norm(), 0.0, 1e-12);
    ASSERT_NEAR((*model().tilted_pixel(*level) - pixel).norm(), 0.0, 1e-8);
  });
  EXPECT_GT(levelled, 400);
}

TEST_P(TiltedCamera, JacobianIsTheDerivative) {
  int checked = 0;
  over_the_image([&](const Pixel& pixel) {
    const auto jacobian = model().direction_jacobian(pixel);
    ASSERT_TRUE(jacobian);
    const double from_zenith_rad = kPi / 2.0 - std::abs(model().direction(pixel)->elevation_rad);
    if (from_zenith_rad >= 2.5 * ImageAxes::kNearCentre_px * jacobian->row(1).norm())
      checked += test::expect_jacobian_is_derivative(model(), pixel);
  });
  EXPECT_GT(checked, 500);
}

/// A tilted camera's azimuths near its optical axis are as certain as those beside the axis; only the zenith is
/// singular.
TEST_P(TiltedCamera, OnlyTheZenithIsUncertain) {
  if (std::max(std::abs(tilt().roll_rad), std::abs(tilt().pitch_rad)) < 0.03)
    GTEST_SKIP() << "the zenith is beside the axis";
  const Pixel centre = upright().axes().pixel({0.0, 0.0});
  const auto at_centre = model().direction_jacobian(centre),
             beside = model().direction_jacobian(centre + Pixel(0.5, 0.0));
  ASSERT_TRUE(at_centre && beside);
  EXPECT_NEAR((*at_centre - *beside).norm(), 0.0, 0.2 * at_centre->norm());
  const Eigen::Vector3d up(0.0, 0.0, model().ray(centre)->z());
  const auto straight_up = model().pixel(up);
  ASSERT_TRUE(straight_up);
  const auto uncertain = model().direction_jacobian(*straight_up);
  EXPECT_TRUE(uncertain->allFinite());
  EXPECT_NEAR(uncertain->row(0).norm(), 1.0 / ImageAxes::kNearCentre_px, 0.3 / ImageAxes::kNearCentre_px);
}

TEST_P(TiltedCamera, TablesHoldItsDirections) {
  if (camera().width_px > 640 || tilt().roll_rad * tilt().pitch_rad == 0.0)
    GTEST_SKIP() << "a table takes long: those of small cameras that lean both ways are enough";
  const CameraModel tilted = model();
  const DirectionTable table(tilted, camera().width_px, camera().height_px);
  over_the_image([&](const Pixel& at) {
    const Pixel pixel = at.array().round();
    const auto exact = tilted.direction(pixel), in_camera = upright().direction(pixel);
    if (!exact || in_camera->elevation_rad < camera().lowest_rad + 0.02 ||
        in_camera->elevation_rad > camera().highest_rad || std::abs(exact->elevation_rad) > 1.4)
      return;
    const auto cell = table.at(pixel);
    ASSERT_TRUE(cell) << pixel.transpose();
    EXPECT_LE(std::abs(wrap(cell->middle.azimuth_rad - exact->azimuth_rad)), cell->half_rad.x() + 1e-6);
    EXPECT_LE(std::abs(cell->middle.elevation_rad - exact->elevation_rad), cell->half_rad.y() + 1e-6);
  });
}

/// Roll raises what is on the left, and pitch lowers what is ahead.
TEST(CameraTilt, IsRightHanded) {
  const CameraModel rolled({{320, 240}}, test::kParabolic, {.roll_rad = 0.1}),
      pitched({{320, 240}}, test::kParabolic, {.pitch_rad = 0.1});
  const Direction ahead{0.0, 0.0}, left{kPi / 2.0, 0.0};
  EXPECT_NEAR(rolled.levelled(left).elevation_rad, 0.1, 1e-12);
  EXPECT_NEAR(rolled.levelled(ahead).elevation_rad, 0.0, 1e-12);
  EXPECT_NEAR(pitched.levelled(ahead).elevation_rad, -0.1, 1e-12);
  EXPECT_NEAR(pitched.levelled(left).elevation_rad, 0.0, 1e-12);
}

TEST(CameraTilt, WithoutOneNothingChangesByABit) {
  for (const NamedCamera& camera : test::cameras()) {
    const CameraModel same(camera.model.axes(), camera.model.profile(), CameraTilt{});
    for (double v = 1; v < camera.height_px; v += 41.7)
      for (double u = 1; u < camera.width_px; u += 37.3) {
        const auto polar = camera.model.axes().polar({u, v});
        const auto direction = same.direction({u, v});
        if (!direction) continue;
        EXPECT_EQ(direction->azimuth_rad, polar.azimuth_rad);
        EXPECT_EQ(*same.level_pixel({u, v}), Pixel(u, v));
      }
  }
}

/// To first order, roll and pitch turn an azimuth by tan(elevation) times their component across the azimuth.
TEST(CameraTilt, VarianceIsThatOfUnknownRollAndPitch) {
  constexpr double kSigma_rad = 1e-4;
  for (const double elevation_rad : {-0.9, -0.2, 0.0, 0.4, 1.2}) {
    for (const double azimuth_rad : {-2.0, 0.0, 0.7, 3.0}) {
      double variance_rad2 = 0.0;
      for (const CameraTilt& tilt : {CameraTilt{kSigma_rad, 0.0}, CameraTilt{0.0, kSigma_rad}}) {
        const CameraModel model({{320, 240}}, test::kParabolic, tilt);
        const double off_rad = wrap(model.levelled({azimuth_rad, elevation_rad}).azimuth_rad - azimuth_rad);
        variance_rad2 += off_rad * off_rad;
      }
      EXPECT_NEAR(azimuth_variance_by_tilt(kSigma_rad, elevation_rad), variance_rad2, 2e-3 * variance_rad2 + 1e-15);
    }
  }
}

}  // namespace
}  // namespace azimuth
