#include "slam/camera/image_mask.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

const ImageAxes kAxes{{50, 40}};

TEST(ImageMask, RingIncludesItsEdges) {
  const ImageMask mask(kAxes, {10, 30, {}});
  EXPECT_FALSE(mask.visible({50, 40}));
  EXPECT_FALSE(mask.visible({59.99, 40}));
  EXPECT_TRUE(mask.visible({60, 40}));
  EXPECT_TRUE(mask.visible({50, 70}));
  EXPECT_FALSE(mask.visible({50, 70.01}));
}

TEST(ImageMask, WithoutBoundsEverythingIsVisible) {
  const ImageMask mask(kAxes, {});
  EXPECT_TRUE(mask.visible({50, 40}));
  EXPECT_TRUE(mask.visible({-1e6, 1e6}));
}

TEST(ImageMask, PolygonsHideInEitherSense) {
  const std::vector<Pixel> strut{{60, 38}, {90, 38}, {90, 42}, {60, 42}};
  const ImageMask mask(kAxes, {0, 100, {strut, {strut.rbegin(), strut.rend()}}});
  EXPECT_FALSE(mask.visible({75, 40}));
  EXPECT_TRUE(mask.visible({75, 37}));
  EXPECT_TRUE(mask.visible({59, 40}));
  EXPECT_TRUE(mask.visible({91, 40}));
}

TEST(ImageMask, ConcavePolygonHidesNoMoreThanItself) {
  const ImageMask mask(kAxes, {0, 1000, {{{0, 0}, {40, 0}, {40, 40}, {20, 10}, {0, 40}}}});
  EXPECT_FALSE(mask.visible({5, 20}));
  EXPECT_FALSE(mask.visible({35, 20}));
  EXPECT_TRUE(mask.visible({20, 20})) << "in the notch";
}

TEST(ImageMask, SharedEdgesBelongToOneOfTwo) {
  const std::vector<Pixel> left{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, right{{10, 0}, {20, 0}, {20, 10}, {10, 10}};
  const ImageMask one(kAxes, {0, 1000, {left}}), other(kAxes, {0, 1000, {right}});
  for (int v = 0; v < 10; ++v) EXPECT_NE(one.visible({10, v}), other.visible({10, v}));
}

TEST(ImageMask, TooFewCornersHideNothing) {
  const ImageMask mask(kAxes, {0, 1000, {{}, {{5, 5}}, {{0, 0}, {10, 10}}}});
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(mask.visible({i, i}));
}

TEST(ImageMask, RasterAgrees) {
  const ImageMask mask(kAxes, {5, 35, {{{20, 20}, {45, 25}, {30, 60}}}});
  const std::vector<std::uint8_t> raster = mask.raster(100, 80);
  ASSERT_EQ(raster.size(), 8000U);
  for (std::size_t v = 0; v < 80; ++v) {
    for (std::size_t u = 0; u < 100; ++u) {
      const bool visible = mask.visible({static_cast<double>(u), static_cast<double>(v)});
      ASSERT_EQ(raster[v * 100 + u], visible ? 255 : 0);
    }
  }
  EXPECT_GT(std::ranges::count(raster, 255), 1000);
  EXPECT_GT(std::ranges::count(raster, 0), 4000);
}

}  // namespace
}  // namespace azimuth
