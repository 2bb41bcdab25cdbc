#include <cmath>
#include <gtest/gtest.h>

#include "tools/plot/axes.hpp"

namespace azimuth {
namespace {

TEST(Extent, GrowsWithItsPoints) {
  Extent extent;
  EXPECT_TRUE(extent.empty);
  extent.include(Eigen::Vector2d(5.0, 6.0));
  EXPECT_EQ(extent.low_m, Eigen::Vector2d(5.0, 6.0));  // the extent does not include the origin
  extent.include(Eigen::Vector2d(-1.0, 8.0));
  extent.include(Eigen::Vector2d(NAN, 100.0));
  EXPECT_EQ(extent.low_m, Eigen::Vector2d(-1.0, 6.0));
  EXPECT_EQ(extent.high_m, Eigen::Vector2d(5.0, 8.0));
}

TEST(Extent, StretchesOnlySoFar) {
  const Extent trusted{{0.0, 0.0}, {10.0, 5.0}, false};
  const Extent near_by{{-1.0, 1.0}, {4.0, 6.0}, false}, far_off{{500.0, -500.0}, {600.0, 2.0}, false};
  EXPECT_EQ(trusted.stretched(near_by, 2.0).low_m, Eigen::Vector2d(-1.0, 0.0));
  EXPECT_EQ(trusted.stretched(near_by, 2.0).high_m, Eigen::Vector2d(10.0, 6.0));
  EXPECT_EQ(trusted.stretched(far_off, 2.0).high_m, Eigen::Vector2d(12.0, 5.0));
  EXPECT_EQ(trusted.stretched(far_off, 2.0).low_m, Eigen::Vector2d(0.0, -2.0));
  EXPECT_EQ(Extent{}.stretched(near_by, 2.0).high_m, near_by.high_m);
}

TEST(TickStep, IsNice) {
  EXPECT_DOUBLE_EQ(tick_step(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(tick_step(10.1, 10), 2.0);
  EXPECT_DOUBLE_EQ(tick_step(41.0, 10), 5.0);
  EXPECT_DOUBLE_EQ(tick_step(0.7, 10), 0.1);
  EXPECT_DOUBLE_EQ(tick_step(0.0, 10), 1.0);
}

TEST(Multiples, AreInsideTheRange) {
  EXPECT_EQ(multiples(-1.5, 4.0, 2.0), (std::vector<double>{0.0, 2.0, 4.0}));
  EXPECT_TRUE(multiples(0.1, 0.9, 1.0).empty());
}

TEST(Axes, KeepTheShapeAndPointUp) {
  const Axes axes({{0.0, 0.0}, {10.0, 5.0}, false}, {100.0, 50.0}, 1000.0, 100.0, 2000.0);
  EXPECT_EQ(axes.size_px(), Eigen::Vector2d(1000.0, 500.0));
  EXPECT_EQ(axes.to_px(Eigen::Vector2d(0.0, 0.0)), Eigen::Vector2d(100.0, 550.0));
  EXPECT_EQ(axes.to_px(Eigen::Vector2d(10.0, 5.0)), Eigen::Vector2d(1100.0, 50.0));
}

TEST(Axes, CentreWhatIsTooNarrow) {
  const Axes axes({{0.0, 0.0}, {1.0, 10.0}, false}, {0.0, 0.0}, 1000.0, 100.0, 500.0);
  EXPECT_DOUBLE_EQ(axes.size_px().y(), 500.0);
  EXPECT_EQ(axes.to_px(Eigen::Vector2d(0.5, 5.0)), Eigen::Vector2d(500.0, 250.0));
}

}  // namespace
}  // namespace azimuth
