#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "sim/world/random.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth {
namespace {

constexpr double kCentre_px = 240.0;

std::vector<KeyPoint> scattered(int count, Random& random, double from_rad = 0.0, double to_rad = 6.28) {
  std::vector<KeyPoint> points;
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(from_rad, to_rad), radius = random.uniform(50.0, 230.0);
    points.push_back({.x_px = static_cast<float>(kCentre_px + radius * std::cos(angle)),
                      .y_px = static_cast<float>(kCentre_px + radius * std::sin(angle)),
                      .sigma_px = 3.0F,
                      .response = std::floor(static_cast<float>(random.uniform(10.0, 60.0))) / 1000.0F});
  }
  return points;
}

std::vector<KeyPoint> selected(std::vector<KeyPoint> points, const SiftSettings& settings = {}) {
  FeatureSelection(settings, kCentre_px).select(points);
  return points;
}

bool same(const KeyPoint& a, const KeyPoint& b) { return !stronger(a, b) && !stronger(b, a); }

TEST(Selection, KeepsAllOfAFew) {
  Random random(1, RandomPurpose::scene);
  const SiftSettings settings;
  EXPECT_EQ(selected(scattered(40, random)).size(), 40U);
  EXPECT_EQ(selected({}).size(), 0U);
  EXPECT_EQ(selected(scattered(500, random)).size(), static_cast<std::size_t>(settings.target_count));
  SiftSettings all;
  all.target_count = 0;
  EXPECT_EQ(selected(scattered(500, random), all).size(), 500U);
}

TEST(Selection, DoesNotDependOnTheOrder) {
  Random random(2, RandomPurpose::scene);
  std::vector<KeyPoint> points = scattered(400, random);
  const std::vector<KeyPoint> expected = selected(points);
  for (int trial = 0; trial < 20; ++trial) {
    for (std::size_t i = points.size() - 1; i > 0; --i)
      std::swap(points[i], points[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i) + 0.999))]);
    EXPECT_TRUE(std::ranges::equal(selected(points), expected, same));
  }
}

TEST(Selection, StrongestFirst) {
  Random random(3, RandomPurpose::scene);
  EXPECT_TRUE(std::ranges::is_sorted(selected(scattered(400, random)), stronger));
}

/// Many strong features in one corner must not use up the target number.
TEST(Selection, LooksAllRound) {
  Random random(4, RandomPurpose::scene);
  std::vector<KeyPoint> points = scattered(200, random);
  std::vector<KeyPoint> corner = scattered(300, random, 0.0, 0.5);
  for (KeyPoint& point : corner) point.response += 0.1F;
  points.insert(points.end(), corner.begin(), corner.end());
  std::array<int, 8> in_eighth{};
  for (const KeyPoint& point : selected(points)) {
    const double angle = std::atan2(point.y_px - kCentre_px, point.x_px - kCentre_px) + kPi;
    ++in_eighth[std::min<std::size_t>(7, static_cast<std::size_t>(angle / (kPi / 4.0)))];
  }
  EXPECT_GE(*std::ranges::min_element(in_eighth), 3);
}

TEST(Selection, EmptySectorsLeaveTheirShareToOthers) {
  Random random(5, RandomPurpose::scene);
  EXPECT_EQ(selected(scattered(400, random, 0.0, 1.0)).size(), static_cast<std::size_t>(SiftSettings{}.target_count));
}

}  // namespace
}  // namespace azimuth
