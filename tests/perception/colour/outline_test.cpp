// Compares outlines with the pixels' sides one by one, and tests the lines and sides fitted to them.

#include "slam/perception/colour/outline.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "slam/geometry/angle.hpp"
#include "tests/perception/colour/class_picture.hpp"

namespace azimuth {
namespace {

using Point = std::pair<double, double>;

std::vector<Point> sorted(const std::vector<CentredPoint>& points) {
  std::vector<Point> out;
  for (const CentredPoint& point : points) out.emplace_back(point.x(), point.y());
  std::ranges::sort(out);
  return out;
}

std::vector<Point> sides_one_by_one(const test::ClassPicture& picture) {
  std::vector<Point> points;
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u) {
      if (picture.at(u, v) == 0) continue;
      for (const auto& [du, dv] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)})
        if (picture.at(u + du, v + dv) == 0) points.emplace_back(u + 0.5 * du, v + 0.5 * dv);
    }
  std::ranges::sort(points);
  return points;
}

TEST(Outline, IsEverySideOfAPixelWithoutANeighbour) {
  std::mt19937 random(5);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::vector<CentredPoint> outline;
  for (int i = 0; i < 200; ++i) {
    test::ClassPicture picture(draw(1, 30), draw(1, 20));
    const int gaps = draw(1, 4);
    picture.paint([&](int, int) { return draw(0, gaps) > 0; });
    outline_of(picture.runs(), {}, outline);
    ASSERT_EQ(sorted(outline), sides_one_by_one(picture));
  }
}

TEST(Outline, IsWhereTheGridPutsIt) {
  const std::vector<ColourRun> one{{3, 2, 3, 1}};
  std::vector<CentredPoint> outline;
  outline_of(one, {{-10.0, 20.0}, {2.0, 4.0}}, outline);
  EXPECT_THAT(sorted(outline), testing::ElementsAre(Point(-7, 32), Point(-6, 30), Point(-6, 34), Point(-5, 32)));
  outline_of({}, {}, outline);
  EXPECT_TRUE(outline.empty());
}

TEST(RadialLine, IsTheLeastSquaresLineTowardsThePoints) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(-kPi, kPi), radius(50.0, 300.0), aside(-8.0, 8.0);
  for (int i = 0; i < 200; ++i) {
    const double middle = angle(random);
    std::vector<CentredPoint> points;
    for (int k = 0; k < 40; ++k) {
      const double along = radius(random), across = aside(random);
      points.emplace_back(along * std::cos(middle) - across * std::sin(middle),
                          along * std::sin(middle) + across * std::cos(middle));
    }
    const auto lateral_error = [&](double at) {
      double sum = 0.0;
      for (const CentredPoint& p : points) sum += std::pow(p.y() * std::cos(at) - p.x() * std::sin(at), 2);
      return sum;
    };
    const double line = radial_line_rad(points);
    ASSERT_LT(std::abs(wrap(line - middle)), 0.05) << "of the two directions the right one";
    ASSERT_LT(lateral_error(line), lateral_error(line + 1e-4));
    ASSERT_LT(lateral_error(line), lateral_error(line - 1e-4));
  }
}

}  // namespace
}  // namespace azimuth
