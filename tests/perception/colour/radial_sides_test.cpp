// Finds the sides of shapes that are painted pixel by pixel.

#include "slam/perception/colour/radial_sides.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "slam/geometry/angle.hpp"
#include "slam/perception/colour/outline.hpp"
#include "tests/perception/colour/class_picture.hpp"

namespace azimuth {
namespace {

constexpr int kSide = 640;
constexpr double kCentre = 319.5;

/// Radius of a pixel, and its angle relative to the wedge's middle.
struct Polar {
  double off_rad, radius_px;
};

/// The outline of the pixels for which `inside` holds, with the shape's axis along `angle_rad`.
std::vector<CentredPoint> outline_of_shape(double angle_rad, const std::function<bool(const Polar&)>& inside) {
  test::ClassPicture picture(kSide, kSide);
  picture.paint([&](int u, int v) {
    const double x = u - kCentre, y = v - kCentre;
    return inside({wrap(std::atan2(y, x) - angle_rad), std::hypot(x, y)});
  });
  std::vector<CentredPoint> outline;
  outline_of(picture.runs(), {{-kCentre, -kCentre}, {1.0, 1.0}}, outline);
  return outline;
}

std::function<bool(const Polar&)> wedge(double half_width_rad, double near_px, double far_px) {
  return [=](const Polar& p) {
    return std::abs(p.off_rad) <= half_width_rad && p.radius_px >= near_px && p.radius_px <= far_px;
  };
}

std::optional<UprightShape> shape_of(
    const std::vector<CentredPoint>& outline, const ColourSettings& settings = {},
    const RadialSides::IsBackground& is_background = [](const CentredPoint&) { return true; }) {
  return RadialSides(settings).find(outline, radial_line_rad(outline), 1.0, is_background);
}

TEST(RadialSides, FindAWedgeToATenthOfAPixelAndSayHowWell) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> angle(-kPi, kPi), half_width(0.015, 0.08), near_px(90.0, 180.0);
  double squared = 0.0, normalised = 0.0;
  constexpr int kShapes = 60;
  for (int i = 0; i < kShapes; ++i) {
    const double at = angle(random), start = near_px(random);
    const auto outline = outline_of_shape(at, wedge(half_width(random), start, start * 1.6));
    const auto shape = shape_of(outline);
    ASSERT_TRUE(shape) << at;
    const double error = wrap(shape->angle_rad - at);
    squared += std::pow(error * 1.3 * start, 2);
    normalised += std::pow(error / shape->sigma_rad, 2);
  }
  EXPECT_LT(std::sqrt(squared / kShapes), 0.1) << "pixels, halfway along";
  EXPECT_GT(std::sqrt(normalised / kShapes), 0.15);
  EXPECT_LT(std::sqrt(normalised / kShapes), 1.3);
}

TEST(RadialSides, MeasureLengthAndWidth) {
  const auto shape = shape_of(outline_of_shape(0.7, wedge(0.05, 120.0, 240.0)));
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->length_px, 120.0, 2.5);
  EXPECT_NEAR(shape->width_px, 2 * std::tan(0.05) * 180.0, 0.7);
}

// The pixel grid makes sides jump by whole pixels, which sigma_side_px covers.
TEST(RadialSides, KnowTheLeastThereIsToError) {
  ColourSettings settings;
  settings.sigma_side_px = 0.0;
  const auto outline = outline_of_shape(-1.2, wedge(0.05, 120.0, 280.0));
  const double least = shape_of(outline, settings)->sigma_rad;
  settings.sigma_side_px = 1.0;  // per side, at the root mean square radius
  EXPECT_NEAR(std::pow(shape_of(outline, settings)->sigma_rad, 2),
              least * least + 0.5 / (200.0 * 200.0 + 160.0 * 160.0 / 12.0), 2e-7);
}

// The rig's centre is wrong by (5, -4) px: the direction must be correct for the radius that accompanies it.
TEST(RadialSides, SayAtWhichRadiusTheDirectionHoldsForACentreThatIsOff) {
  const CentredPoint off_px(5.0, -4.0);
  for (const double at : {-2.5, -1.0, 0.2, 1.4, 2.8}) {
    auto outline = outline_of_shape(at, wedge(0.05, 110.0, 240.0));
    for (CentredPoint& point : outline) point -= off_px;
    const auto shape = shape_of(outline);
    ASSERT_TRUE(shape) << at;
    EXPECT_LT(shape->sigma_rad, 4e-3);
    const CentredPoint seen = shape->radius_px * CentredPoint(std::cos(shape->angle_rad), std::sin(shape->angle_rad));
    const CentredPoint really = seen + off_px;
    EXPECT_NEAR(wrap(std::atan2(really.y(), really.x()) - at), 0.0, 2e-3) << at;
  }
}

// A poster of the same colour behind a part of one side.
TEST(RadialSides, PassOverWhatIsMergedWithAPartOfASide) {
  const auto main = wedge(0.05, 120.0, 260.0);
  const auto outline = outline_of_shape(2.0, [&](const Polar& p) {
    return main(p) || (p.off_rad > 0.0 && p.off_rad < 0.12 && p.radius_px > 200.0 && p.radius_px < 240.0);
  });
  const auto shape = shape_of(outline);
  ASSERT_TRUE(shape);
  EXPECT_NEAR(wrap(shape->angle_rad - 2.0), 0.0, 1e-3);
  EXPECT_GT(std::abs(wrap(radial_line_rad(outline) - 2.0)), 4e-3) << "least squares over everything does not";
}

TEST(RadialSides, RefuseWhatHasNoTwoSidesAlongTheRadius) {
  EXPECT_FALSE(shape_of(outline_of_shape(0.3, [](const Polar& p) {  // a disc
    return std::hypot(p.radius_px * std::cos(p.off_rad) - 200.0, p.radius_px * std::sin(p.off_rad)) < 30.0;
  })));
  EXPECT_FALSE(shape_of(outline_of_shape(0.3, [](const Polar& p) {  // leans by 20 degrees
    const double along = p.radius_px * std::cos(p.off_rad) - 200.0, aside = p.radius_px * std::sin(p.off_rad);
    return std::abs(along) < 50.0 && std::abs(aside - 0.36 * along) < 10.0;
  })));
  EXPECT_FALSE(shape_of(outline_of_shape(0.3, [](const Polar& p) {  // covers the centre
    const double along = p.radius_px * std::cos(p.off_rad), aside = p.radius_px * std::sin(p.off_rad);
    return along > -20.0 && along < 100.0 && std::abs(aside) < 10.0;
  })));
  EXPECT_FALSE(shape_of({}));
  EXPECT_FALSE(shape_of({CentredPoint(100.0, 0.0), CentredPoint(101.0, 0.0)}));
}

/// Everything is background except the area beside the shape, towards greater angles, between two radii.
RadialSides::IsBackground hidden_beside(double angle_rad, double near_px, double far_px) {
  return [=](const CentredPoint& point) {
    const bool beside = wrap(std::atan2(point.y(), point.x()) - angle_rad) > 0.0;
    return !(beside && point.norm() > near_px && point.norm() < far_px);
  };
}

TEST(RadialSides, NeedAFreePartOfEachSide) {
  const auto outline = outline_of_shape(1.0, wedge(0.05, 120.0, 240.0));
  const auto half_free = shape_of(outline, {}, hidden_beside(1.0, 0.0, 180.0));
  ASSERT_TRUE(half_free);
  EXPECT_NEAR(half_free->angle_rad, 1.0, 1e-3);
  EXPECT_FALSE(shape_of(outline, {}, hidden_beside(1.0, 0.0, 230.0)));
  EXPECT_FALSE(shape_of(outline, {}, hidden_beside(1.0, 0.0, 1000.0)));
}

}  // namespace
}  // namespace azimuth
