#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sim/world/random.hpp"
#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth {
namespace {

TEST(Neighbours, AreTheNearestByManhattanDistance) {
  Random random(1, RandomPurpose::scene);
  for (const std::size_t count : {0U, 1U, 2U, 5U, 6U, 7U, 90U}) {
    std::vector<KeyPoint> points(count);
    for (KeyPoint& point : points) {  // whole numbers, so that some distances are equal
      point.x_px = std::floor(static_cast<float>(random.uniform(0.0, 20.0)));
      point.y_px = std::floor(static_cast<float>(random.uniform(0.0, 20.0)));
    }
    std::vector<Neighbours> found;
    find_neighbours(points, found);
    ASSERT_EQ(found.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::uint16_t> others;
      for (std::uint16_t j = 0; j < count; ++j)
        if (j != i) others.push_back(j);
      std::ranges::stable_sort(others, {}, [&](std::uint16_t j) {
        return std::abs(points[j].x_px - points[i].x_px) + std::abs(points[j].y_px - points[i].y_px);
      });
      others.resize(Neighbours::kMost, Neighbours::kNone);
      EXPECT_TRUE(std::ranges::equal(found[i].index, others)) << count << " " << i;
    }
  }
}

}  // namespace
}  // namespace azimuth
