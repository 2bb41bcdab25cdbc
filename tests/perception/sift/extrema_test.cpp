#include "slam/perception/sift/extrema.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/perception/sift/pictures.hpp"

namespace azimuth {
namespace {

using test::Blob;

std::vector<KeyPoint> found_in(const Plane<std::uint16_t>& image, const VisibleRegion& region,
                               const SiftSettings& settings = {}) {
  ScaleSpace space(settings);
  space.build(image);
  std::vector<KeyPoint> found;
  ExtremumFinder(settings).find(space, region, settings.contrast, found);
  return found;
}

std::vector<KeyPoint> found_in(const Plane<std::uint16_t>& image, const SiftSettings& settings = {}) {
  return found_in(image, test::whole_region(image.width()), settings);
}

TEST(Extrema, FindsBlobsBetweenPixels) {
  Random random(1, RandomPurpose::scene);
  for (int trial = 0; trial < 60; ++trial) {
    const Blob blob{random.uniform(70.0, 90.0), random.uniform(70.0, 90.0), random.uniform(2.5, 12.0),
                    trial % 2 == 0 ? 90.0 : -90.0};
    const std::vector<KeyPoint> found = found_in(test::picture(160, {blob}));
    ASSERT_FALSE(found.empty()) << trial;
    const KeyPoint& best = *std::ranges::min_element(found, stronger);
    EXPECT_NEAR(best.x_px, blob.x_px, 0.05 * blob.sigma_px) << trial;
    EXPECT_NEAR(best.y_px, blob.y_px, 0.05 * blob.sigma_px) << trial;
    // The difference of Gaussians responds best to a blob somewhat larger than the smaller of its two scales.
    EXPECT_NEAR(best.sigma_px / blob.sigma_px, 0.89, 0.06) << trial;
  }
}

TEST(Extrema, PlacesDoNotDependOnTheSideOfThePixel) {
  double sum = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Blob blob{80.0 + 0.05 * i, 80.0, 4.0, 90.0};
    const std::vector<KeyPoint> found = found_in(test::picture(160, {blob}));
    ASSERT_FALSE(found.empty());
    sum += std::ranges::min_element(found, stronger)->x_px - blob.x_px;
  }
  EXPECT_NEAR(sum / 20, 0.0, 0.02);
}

TEST(Extrema, StepsAndLinesAreNoKeyPoints) {
  Plane<std::uint16_t> image(120, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) image.at(x, y) = x + y > 125 || (x > 40 && x < 44) ? 60000 : 10000;
  for (const KeyPoint& point : found_in(image)) {  // there may be features where the line meets the step
    EXPECT_NEAR(point.x_px, 42.0F, 25.0F);
    EXPECT_NEAR(point.y_px, 83.0F, 35.0F);
  }
}

TEST(Extrema, WeakBlobsAreRefused) {
  SiftSettings settings;
  const auto count = [&](double gray_levels) {
    return found_in(test::picture(100, {Blob{50, 50, 5, gray_levels}}), settings).size();
  };
  settings.contrast = 0.03;
  EXPECT_EQ(count(40.0), 0U);
  EXPECT_GT(count(120.0), 0U);
}

TEST(Extrema, NothingNearWhatIsHidden) {
  std::vector<Blob> blobs;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) blobs.push_back({30.0 + 40 * i, 30.0 + 40 * j, 4.0, 80.0});
  const Plane<std::uint16_t> image = test::picture(220, blobs);
  const ImageAxes axes{{109.5, 109.5}, 1.0, -1, 0.0};
  const MaskShape mask{20.0, 100.0, {{{120.0, 100.0}, {200.0, 100.0}, {200.0, 119.0}, {120.0, 119.0}}}};
  const VisibleRegion region(working_square(axes, 110.0, 0), mask, 220, 220);
  const SiftSettings settings;
  const std::vector<KeyPoint> found = found_in(image, region, settings);
  EXPECT_GT(found.size(), 8U);
  EXPECT_LT(found.size(), found_in(image).size());
  const ImageMask visible(axes, mask);
  for (const KeyPoint& point : found) {
    const double reach_px = settings.clearance_sigmas * point.sigma_px - 1.5;
    for (int i = 0; i < 16; ++i)
      EXPECT_TRUE(visible.visible(
          {point.x_px + reach_px * std::cos(i * kPi / 8), point.y_px + reach_px * std::sin(i * kPi / 8)}));
  }
}

TEST(Extrema, OneGreyHasNone) { EXPECT_TRUE(found_in(test::picture(100, {})).empty()); }

TEST(Extrema, NoiseKeepsTheStrongestOfABoundedNumber) {
  Random random(5, RandomPurpose::scene);
  SiftSettings settings;
  settings.contrast = 1e-6;
  settings.first_sigma_px = 0.8;
  settings.camera_sigma_px = 0.5;
  settings.clearance_sigmas = 0.0;
  const Plane<std::uint16_t> image = test::noise(480, random);
  const std::vector<KeyPoint> found = found_in(image, settings);
  EXPECT_LE(found.size(), ExtremumFinder::kMost);
  EXPECT_GT(found.size(), ExtremumFinder::kMost / 3);
  settings.contrast = 1.2 * std::ranges::max_element(found, stronger)->response;
  for (const KeyPoint& strong : found_in(image, settings)) {
    const auto same = [&](const KeyPoint& other) { return !stronger(strong, other) && !stronger(other, strong); };
    EXPECT_TRUE(std::ranges::any_of(found, same)) << "a stronger one was dropped";
  }
}

}  // namespace
}  // namespace azimuth
