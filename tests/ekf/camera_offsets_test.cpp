// Azimuths of a camera whose image centre and tilt differ from its rig.

#include "slam/ekf/camera_offsets.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "slam/ekf/camera_errors.hpp"
#include "tests/camera/cameras.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

const ImageAxes kAxes{{320.0, 240.0}, 1.0, -1, 0.3};

class CameraOffsetsOf : public testing::TestWithParam<test::NamedCamera> {
 protected:
  const RadialProfile& profile() const { return GetParam().model.profile(); }
  /// A direction whose pixel lies between the centre and the rim.
  Direction seen(RandomDraws& draws) const {
    return {draws.uniform(-kPi, kPi),
            draws.uniform(std::max(GetParam().lowest_rad, -0.9) + 0.1, std::min(GetParam().highest_rad, 1.2) - 0.1)};
  }
};

Eigen::Vector4d errors_of(double offset_px, double tilt_rad, RandomDraws& draws) {
  const double offset_way = draws.uniform(-kPi, kPi), tilt_way = draws.uniform(-kPi, kPi);
  return {offset_px * std::cos(offset_way), offset_px * std::sin(offset_way), tilt_rad * std::cos(tilt_way),
          tilt_rad * std::sin(tilt_way)};
}

TEST_P(CameraOffsetsOf, AreWhatACameraThatLeansShows) {
  constexpr double kTilt_rad = 0.01;
  const CameraModel level(kAxes, profile());
  RandomDraws draws(7);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector4d errors = errors_of(0.0, kTilt_rad, draws);
    const CameraModel leaning(kAxes, profile(), {errors(2), errors(3)});
    const Direction direction = seen(draws);
    const auto pixel = leaning.pixel(direction);
    ASSERT_TRUE(pixel);
    const PolarPixel polar = kAxes.polar(*pixel);
    const Eigen::Vector2d p = centred(polar.azimuth_rad, polar.radius_px, errors, profile()).p_px;
    EXPECT_NEAR(wrap(std::atan2(p.y(), p.x()) - direction.azimuth_rad), 0.0, kTilt_rad * kTilt_rad);
  }
}

TEST_P(CameraOffsetsOf, HaveTheirDerivatives) {
  RandomDraws draws(8);
  using Sizes = std::pair<double, double>;  // offset [px], tilt [rad]
  for (const auto& [offset_px, tilt_rad] : {Sizes{0.0, 0.0}, Sizes{1e-3, 1e-6}, Sizes{8.0, 0.03}}) {
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector4d errors = errors_of(offset_px, tilt_rad, draws);
      const PolarPixel polar = kAxes.polar(*CameraModel(kAxes, profile()).pixel(seen(draws)));
      if (polar.radius_px < 20.0) continue;
      CameraOffsets offsets{0.1, std::nullopt, 0, profile()};
      const auto corrected = [&](const Eigen::VectorXd& at) {
        return offsets.correct(polar.azimuth_rad, polar.radius_px, [&](Index entry) { return at(entry); });
      };
      const auto azimuth = [&](const Eigen::VectorXd& at) {
        return Eigen::VectorXd::Constant(1, corrected(at).azimuth_rad);
      };
      EXPECT_LT(largest_difference(corrected(errors).by_camera, numeric_jacobian(azimuth, errors, {0}, 1e-4)),
                kJacobianTolerance)
          << polar.radius_px;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, CameraOffsetsOf, testing::ValuesIn(test::cameras()),
                         [](const auto& of) { return of.param.name; });

TEST(CameraErrors, OfTwoThatLookAlikeSayWhereTheCentreIsIfTheOtherIsKnown) {
  const Eigen::Vector4d sigma(3.0, 3.0, 0.02, 0.02);
  CameraErrors errors{{4.0, 0.0, 0.01, 0.0}, sigma.cwiseAbs2().asDiagonal()};
  errors.covariance(0, 2) = errors.covariance(2, 0) = -0.8 * 3.0 * 0.02;
  const CentreOffset as_found = errors.centre_given(errors.mean.tail<2>()), level = errors.centre_given({0.0, 0.0});
  EXPECT_EQ(as_found.mean_px, Eigen::Vector2d(4.0, 0.0));
  EXPECT_NEAR(level.mean_px.x(), 4.0 + 0.8 * 3.0 / 0.02 * 0.01, 1e-9);
  EXPECT_NEAR(level.covariance_px2(0, 0), 9.0 * (1.0 - 0.64), 1e-9);
  EXPECT_NEAR(level.covariance_px2(1, 1), 9.0, 1e-9);
  errors.covariance.bottomRows<2>().setZero();
  errors.covariance.rightCols<2>().setZero();
  EXPECT_EQ(errors.centre_given({0.0, 0.0}).mean_px, Eigen::Vector2d(4.0, 0.0)) << "of an exact one nothing is told";
}

}  // namespace
}  // namespace azimuth
