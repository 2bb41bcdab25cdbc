// The camera profiles, compared with the optics they describe. Each test uses another derivation than the code.

#include <gtest/gtest.h>

#include "tests/camera/cameras.hpp"

namespace azimuth {
namespace {

using Eigen::Vector2d;

/// Follows a light ray in the plane of the mirror's axis (x outwards, z up, origin half-way between the foci). The ray
/// comes from the world towards the focus, is reflected where it meets the hyperbola, and enters the optical centre of
/// the camera.
double radius_by_reflection_px(const HyperbolicMirror& mirror, double elevation_rad) {
  const double a = mirror.a_mm, b = mirror.b_mm, c = std::hypot(a, b);
  const Vector2d focus{0.0, c}, camera{0.0, -c};
  const Vector2d out{std::cos(elevation_rad), std::sin(elevation_rad)};
  // (c + s z)^2 / a^2 - (s x)^2 / b^2 = 1; the root lies on the sheet around the focus.
  const double qa = out.y() * out.y() / (a * a) - out.x() * out.x() / (b * b);
  const double qb = 2 * c * out.y() / (a * a), qc = c * c / (a * a) - 1;
  const double root = std::sqrt(qb * qb - 4 * qa * qc);
  double distance = INFINITY;
  for (const double s : {(-qb + root) / (2 * qa), (-qb - root) / (2 * qa)}) {
    if (s > 0 && c + s * out.y() > 0) distance = std::min(distance, s);
  }
  const Vector2d at = focus + distance * out;
  const Vector2d normal = Vector2d(-at.x() / (b * b), at.y() / (a * a)).normalized();
  const Vector2d reflected = -out - 2 * normal.dot(-out) * normal;
  const Vector2d to_camera = (camera - at).normalized();
  EXPECT_NEAR((reflected - to_camera).norm(), 0.0, 1e-12) << "the law of reflection";
  return mirror.focal_length_px * to_camera.x() / to_camera.y() * (to_camera.y() < 0 ? 1 : NAN);
}

TEST(HyperbolicMirror, ReflectsIntoTheCamera) {
  for (double elevation = -1.5; elevation < 0.85; elevation += 0.01) {
    const auto radius_px = test::kHyperbolic.radius_px(elevation);
    ASSERT_TRUE(radius_px);
    EXPECT_NEAR(*radius_px, radius_by_reflection_px(test::kHyperbolic, elevation), 1e-9) << elevation;
  }
}

TEST(HyperbolicMirror, EndsAtTheAsymptote) {
  const double c = std::hypot(test::kHyperbolic.a_mm, test::kHyperbolic.b_mm);
  const double highest = std::asin(test::kHyperbolic.a_mm / c);
  EXPECT_TRUE(test::kHyperbolic.radius_px(highest - 1e-9));
  EXPECT_FALSE(test::kHyperbolic.radius_px(highest + 1e-9));
  const double rim_px = test::kHyperbolic.focal_length_px * test::kHyperbolic.b_mm / test::kHyperbolic.a_mm;
  ASSERT_TRUE(test::kHyperbolic.elevation_at(rim_px - 1e-6));
  EXPECT_NEAR(test::kHyperbolic.elevation_at(rim_px - 1e-6)->elevation_rad, highest, 1e-6);
  EXPECT_FALSE(test::kHyperbolic.elevation_at(rim_px + 1e-6));
}

TEST(HyperbolicMirror, OnlyTheRatioOfItsSidesMatters) {
  const HyperbolicMirror larger{3 * 28.095, 3 * 23.4125, 1035.376};
  EXPECT_NEAR(*larger.radius_px(0.1), *test::kHyperbolic.radius_px(0.1), 1e-9);
}

/// At xi = 1 the unified model is the parabolic mirror: r = gamma sin(theta) / (cos(theta) + 1), with theta from
/// straight down.
TEST(ParabolicMirror, IsTheUnifiedModelAtOne) {
  for (double elevation = -1.5; elevation < 1.2; elevation += 0.01) {
    const double theta = elevation + kPi / 2;
    EXPECT_NEAR(*test::kParabolic.radius_px(elevation), 285.403 * std::sin(theta) / (std::cos(theta) + 1), 1e-9);
  }
  EXPECT_NEAR(*test::kParabolic.radius_px(0.0), 285.403, 1e-9) << "the horizon";
}

TEST(PajdlaFisheye, WithTheSineAloneIsOrthographicAndWithTheTangentPerspective) {
  const PajdlaFisheye sine{0.0, 1.0, 200.0, 1.0, 1.5}, tangent{200.0, 1.0, 0.0, 1.0, 1.4};
  EXPECT_NEAR(sine.elevation_at(100.0)->elevation_rad, kPi / 2 - std::asin(0.5), 1e-15);
  EXPECT_NEAR(tangent.elevation_at(100.0)->elevation_rad, kPi / 2 - std::atan(0.5), 1e-15);
}

TEST(PajdlaFisheye, InverseIsExactUpToTheRim) {
  for (const PajdlaFisheye& fisheye :
       {test::kPajdla, PajdlaFisheye{11892.7456, 100, 11892.7456, 100, 1.5}, PajdlaFisheye{300, 1.1, -100, 1.3, 1.7},
        PajdlaFisheye{1.0, 1.01, 250.0, 1.0, 1.56}}) {
    ASSERT_EQ(fisheye.problem(), std::nullopt);
    for (int i = 0; i <= 1000; ++i) {
      const double theta = fisheye.theta_max_rad * i / 1000;
      const double radius_px = fisheye.radius_at_px(theta);
      const auto at = fisheye.elevation_at(radius_px);
      ASSERT_TRUE(at) << theta;
      EXPECT_NEAR(fisheye.radius_at_px(kPi / 2 - at->elevation_rad), radius_px, 1e-12 * (1 + radius_px)) << theta;
    }
    EXPECT_FALSE(fisheye.elevation_at(fisheye.radius_at_px(fisheye.theta_max_rad) + 1e-9));
  }
}

TEST(EquidistantFisheye, IsALine) {
  EXPECT_NEAR(*test::kEquidistant.radius_px(kPi / 2 - 1.0), 237.85, 1e-12);
  EXPECT_FALSE(test::kEquidistant.radius_px(kPi / 2 - 1.51));
}

/// The lens of the rendered hall is nearly equidistant, because b = d = 100 flattens tangent and sine.
TEST(EquidistantFisheye, IsTheLimitOfPajdlas) {
  const PajdlaFisheye nearly{11892.7456, 100, 11892.7456, 100, 1.5};
  for (double theta = 0.0; theta < 1.5; theta += 0.1) {
    EXPECT_NEAR(nearly.radius_at_px(theta), 237.854912 * theta, 0.02);
  }
}

}  // namespace
}  // namespace azimuth
