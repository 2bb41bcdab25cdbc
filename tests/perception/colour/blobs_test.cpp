// Compares blobs, their areas and perimeters with a computation pixel by pixel.

#include "slam/perception/colour/blobs.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "tests/perception/colour/class_picture.hpp"

namespace azimuth {
namespace {

using test::ClassPicture;

/// Clears the connected region around (u, v) and returns its area.
int flood(ClassPicture& picture, int u, int v) {
  const std::uint8_t its = picture.at(u, v);
  std::vector<std::pair<int, int>> open{{u, v}};
  picture.classes[picture.index(u, v)] = 0;
  int area = 0;
  for (; !open.empty(); ++area) {
    const auto [x, y] = open.back();
    open.pop_back();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (picture.at(x + dx, y + dy) == its) {
          picture.classes[picture.index(x + dx, y + dy)] = 0;
          open.emplace_back(x + dx, y + dy);
        }
  }
  return area;
}

/// The areas of all blobs, in the order of their first pixels.
std::vector<int> flooded_areas(ClassPicture picture) {
  std::vector<int> areas;
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u)
      if (picture.at(u, v) != 0) areas.push_back(flood(picture, u, v));
  return areas;
}

TEST(Blobs, HangTogetherAsFloodFillSays) {
  std::mt19937 random(3);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Blobs blobs;
  for (int i = 0; i < 300; ++i) {
    ClassPicture picture(draw(1, 40), draw(1, 30));
    const int classes = draw(1, 3), gaps = draw(1, 5);
    for (std::uint8_t& each : picture.classes)
      each = draw(0, gaps) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(draw(1, classes));
    const std::vector<ColourRun> runs = picture.runs();
    blobs.group(runs);
    std::vector<int> areas;
    for (const Blob& blob : blobs.all()) areas.push_back(blob.area);
    ASSERT_EQ(areas, flooded_areas(picture));
    for (int v = -1; v <= picture.height; ++v)
      for (int u = -1; u <= picture.width; ++u) ASSERT_EQ(blobs.class_at(u, v), picture.at(u, v));
  }
}

TEST(Blobs, HoldEachRunOnceInItsOrder) {
  std::mt19937 random(4);
  ClassPicture picture(60, 60);
  for (std::uint8_t& each : picture.classes)
    each = static_cast<std::uint8_t>(std::uniform_int_distribution<int>(0, 2)(random));
  const std::vector<ColourRun> runs = picture.runs();
  Blobs blobs;
  blobs.group(runs);
  std::vector<ColourRun> of_blob;
  std::size_t count = 0;
  const auto before = [](const ColourRun& a, const ColourRun& b) {
    return std::pair(a.row, a.begin) < std::pair(b.row, b.begin);
  };
  for (const Blob& blob : blobs.all()) {
    blobs.runs_of(blob, of_blob);
    EXPECT_TRUE(std::ranges::is_sorted(of_blob, before));
    for (const ColourRun& run : of_blob) EXPECT_EQ(run.class_number, blob.class_number);
    count += of_blob.size();
  }
  EXPECT_EQ(count, runs.size());
}

TEST(Blobs, StartAfresh) {
  Blobs blobs;
  const std::vector<ColourRun> some{{0, 1, 3, 1}, {1, 2, 5, 1}}, none;
  blobs.group(some);
  EXPECT_EQ(blobs.all().size(), 1U);
  EXPECT_EQ(blobs.class_at(2, 1), 1);
  blobs.group(none);
  EXPECT_TRUE(blobs.all().empty());
  EXPECT_EQ(blobs.class_at(2, 1), 0);
}

double perimeter_of(const ClassPicture& picture) {
  const std::vector<ColourRun> runs = picture.runs();
  Blobs blobs;
  blobs.group(runs);
  EXPECT_EQ(blobs.all().size(), 1U);
  return blobs.all().empty() ? 0.0 : blobs.all().front().perimeter;
}

TEST(Perimeter, OfADiscIsRight) {
  for (const double radius : {8.0, 20.5, 45.25}) {
    ClassPicture picture(100, 100);
    picture.paint([&](int u, int v) { return std::hypot(u - 50.2, v - 49.7) <= radius; });
    EXPECT_NEAR(perimeter_of(picture), 2 * std::numbers::pi * radius, 0.03 * 2 * std::numbers::pi * radius);
  }
}

TEST(Perimeter, OfARectangleInAnyDirectionIsWithinSixPercent) {
  constexpr double kLength = 80.0, kWidth = 20.0;
  for (int degrees = 0; degrees < 180; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180.0;
    ClassPicture picture(120, 120);
    picture.paint([&](int u, int v) {
      const double x = u - 60.0, y = v - 60.0;
      return std::abs(x * std::cos(angle) + y * std::sin(angle)) <= kLength / 2 &&
             std::abs(y * std::cos(angle) - x * std::sin(angle)) <= kWidth / 2;
    });
    EXPECT_NEAR(perimeter_of(picture), 2 * (kLength + kWidth), 0.06 * 2 * (kLength + kWidth)) << degrees;
  }
}

TEST(Perimeter, CountsHoles) {
  const auto in_square = [](int u, int v, int low, int high) { return u >= low && u < high && v >= low && v < high; };
  ClassPicture whole(40, 40), holed(40, 40);
  whole.paint([&](int u, int v) { return in_square(u, v, 10, 30); });
  holed.paint([&](int u, int v) { return in_square(u, v, 10, 30) && !in_square(u, v, 15, 25); });
  EXPECT_NEAR(perimeter_of(holed) / perimeter_of(whole), 1.5, 0.03);
}

TEST(Compactness, OfDiscAndSquare) {
  EXPECT_DOUBLE_EQ(compactness(std::numbers::pi * 9.0, 2 * std::numbers::pi * 3.0), 1.0);
  EXPECT_DOUBLE_EQ(compactness(100.0, 40.0), std::numbers::pi / 4);
}

}  // namespace
}  // namespace azimuth
