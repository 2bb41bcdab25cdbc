#include "slam/perception/image/visible_region.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

constexpr int kSide_px = 80;
const ImageAxes kAxes{{45.0, 42.0}, 1.0, -1, 0.0};
const MaskShape kRing{8.0, 36.0, {{{50.0, 20.0}, {56.0, 20.0}, {56.0, 34.0}, {50.0, 34.0}}}};

struct Region {
  WorkingSquare square = working_square(kAxes, 40.0, 0);
  VisibleRegion region{square, kRing, 100, 90};
};

TEST(VisibleRegion, ClearanceIsTheDistanceToWhatIsHidden) {
  const Region here;
  ASSERT_EQ(here.region.side_px(), kSide_px);
  EXPECT_FALSE(here.region.empty());
  const auto hidden = [&](int x, int y) {
    return here.region.clearance_px(static_cast<float>(x), static_cast<float>(y)) == 0.0F;
  };
  const ImageMask mask(kAxes, kRing);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = y % 4; x < kSide_px; x += 4) {
      ASSERT_TRUE(hidden(x, y) || mask.visible(here.square.camera_pixel(x, y)));
      double nearest_px = std::min({x + 1, y + 1, kSide_px - x, kSide_px - y});
      for (int v = 0; v < kSide_px; ++v)
        for (int u = 0; u < kSide_px; ++u)
          if (hidden(u, v)) nearest_px = std::min(nearest_px, std::hypot(u - x, v - y));
      ASSERT_NEAR(here.region.clearance_px(static_cast<float>(x), static_cast<float>(y)), nearest_px, 0.3);
    }
  }
}

TEST(VisibleRegion, IsNothingOutside) {
  const Region here;
  EXPECT_EQ(here.region.clearance_px(-1.0F, 40.0F), 0.0F);
  EXPECT_EQ(here.region.clearance_px(40.0F, 80.0F), 0.0F);
  EXPECT_EQ(here.region.clearance_px(1e6F, -1e6F), 0.0F);
}

TEST(VisibleRegion, SpansHoldAllThatIsVisible) {
  const Region here;
  for (int y = 0; y < kSide_px; ++y) {
    const VisibleRegion::Span span = here.region.span(y);
    for (int x = y % 4; x < kSide_px; x += 4) {
      const bool visible = here.region.clearance_px(static_cast<float>(x), static_cast<float>(y)) > 0.0F;
      EXPECT_TRUE(!visible || (x >= span.first && x < span.last));
    }
  }
}

TEST(VisibleRegion, FillsFromTheNearestVisiblePixel) {
  const Region here;
  Plane<std::uint16_t> image(kSide_px, kSide_px);
  for (int y = 0; y < kSide_px; ++y)
    for (int x = 0; x < kSide_px; ++x) image.at(x, y) = static_cast<std::uint16_t>(y * kSide_px + x);
  here.region.fill(image);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = y % 4; x < kSide_px; x += 4) {
      const int from_x = image.at(x, y) % kSide_px, from_y = image.at(x, y) / kSide_px;
      ASSERT_GT(here.region.clearance_px(static_cast<float>(from_x), static_cast<float>(from_y)), 0.0F);
      double nearest_px = std::numeric_limits<double>::infinity();
      for (int v = 0; v < kSide_px; ++v)
        for (int u = 0; u < kSide_px; ++u)
          if (here.region.clearance_px(static_cast<float>(u), static_cast<float>(v)) > 0.0F)
            nearest_px = std::min(nearest_px, std::hypot(u - x, v - y));
      ASSERT_NEAR(std::hypot(from_x - x, from_y - y), nearest_px, 0.5);
    }
  }
}

TEST(VisibleRegion, AllHiddenIsEmptyAndFillsNothing) {
  const WorkingSquare square = working_square(kAxes, 40.0, 0);
  const VisibleRegion region(square, {60.0, 70.0, {}}, 100, 90);
  EXPECT_TRUE(region.empty());
  Plane<std::uint16_t> image(kSide_px, kSide_px);
  image.at(40, 40) = 77;
  region.fill(image);
  EXPECT_EQ(image.at(40, 40), 77);
}

}  // namespace
}  // namespace azimuth
