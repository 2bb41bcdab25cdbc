#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "slam/perception/colour/class_table.hpp"

namespace azimuth {
namespace {

Rgb random_colour(std::mt19937& random) {
  std::uniform_int_distribution<int> sample(0, 255);
  const auto draw = [&] { return static_cast<std::uint8_t>(sample(random)); };
  return {draw(), draw(), draw()};
}

/// The inverse conversion by definition: the distance of each sample from the largest one.
double sample_of(const Hsv& hsv, double offset) {
  const double k = std::fmod(offset + hsv.hue_deg / 60.0, 6.0);
  return 255.0 * hsv.value * (1.0 - hsv.saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
}

TEST(Hsv, OfPureColoursAndGreys) {
  EXPECT_EQ(hsv_of({255, 0, 0}).hue_deg, 0.0);
  EXPECT_EQ(hsv_of({255, 255, 0}).hue_deg, 60.0);
  EXPECT_EQ(hsv_of({0, 255, 0}).hue_deg, 120.0);
  EXPECT_EQ(hsv_of({0, 0, 255}).hue_deg, 240.0);
  EXPECT_EQ(hsv_of({255, 0, 1}).hue_deg, 360.0 - 60.0 / 255.0);
  EXPECT_EQ(hsv_of({0, 0, 0}).saturation, 0.0);
  EXPECT_EQ(hsv_of({255, 255, 255}).value, 1.0);
  EXPECT_EQ(hsv_of({200, 100, 100}).saturation, 0.5);
}

TEST(Hsv, HoldsAllOfAColour) {
  std::mt19937 random(1);
  for (int i = 0; i < 10000; ++i) {
    const Rgb colour = random_colour(random);
    const Hsv hsv = hsv_of(colour);
    ASSERT_GE(hsv.hue_deg, 0.0);
    ASSERT_LT(hsv.hue_deg, 360.0);
    ASSERT_NEAR(sample_of(hsv, 5.0), colour.red, 1e-9);
    ASSERT_NEAR(sample_of(hsv, 3.0), colour.green, 1e-9);
    ASSERT_NEAR(sample_of(hsv, 1.0), colour.blue, 1e-9);
  }
}

TEST(Hsv, LightChangesNeitherHueNorSaturation) {
  const Hsv full = hsv_of({200, 100, 40}), half = hsv_of({100, 50, 20});
  EXPECT_NEAR(full.hue_deg, half.hue_deg, 1e-12);
  EXPECT_NEAR(full.saturation, half.saturation, 1e-12);
}

/* BT.601: Y = 0.299 R + 0.587 G + 0.114 B, Cb = (B - Y) / 1.772, Cr = (R - Y) / 1.402. */
TEST(Yuv, RoundTripsInBothRanges) {
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0))); };
  std::mt19937 random(2);
  for (int i = 0; i < 10000; ++i) {
    const Rgb colour = random_colour(random);
    const double y = 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue;
    const double cb = (colour.blue - y) / 1.772, cr = (colour.red - y) / 1.402;
    const Rgb full = rgb_of_yuv(byte(y), byte(128 + cb), byte(128 + cr), true);
    const Rgb limited =
        rgb_of_yuv(byte(16 + y * 219 / 255), byte(128 + cb * 224 / 255), byte(128 + cr * 224 / 255), false);
    for (const Rgb& back : {full, limited}) {
      ASSERT_NEAR(back.red, colour.red, 3);
      ASSERT_NEAR(back.green, colour.green, 3);
      ASSERT_NEAR(back.blue, colour.blue, 3);
    }
  }
}

TEST(HueBetween, PassesThroughZero) {
  EXPECT_TRUE(hue_between(350.0, 340.0, 20.0));
  EXPECT_TRUE(hue_between(0.0, 340.0, 20.0));
  EXPECT_TRUE(hue_between(20.0, 340.0, 20.0));
  EXPECT_FALSE(hue_between(180.0, 340.0, 20.0));
  EXPECT_TRUE(hue_between(45.0, 40.0, 70.0));
  EXPECT_FALSE(hue_between(39.9, 40.0, 70.0));
  EXPECT_FALSE(hue_between(350.0, 40.0, 70.0));
}

TEST(Fits, EveryBoundCounts) {
  const ColourClass colours{"green", 100.0, 140.0, 0.4, 0.9, 0.3, 0.8};
  EXPECT_TRUE(fits(colours, {120.0, 0.5, 0.5}));
  for (const Hsv& outside : {Hsv{99.0, 0.5, 0.5}, Hsv{141.0, 0.5, 0.5}, Hsv{120.0, 0.39, 0.5}, Hsv{120.0, 0.91, 0.5},
                             Hsv{120.0, 0.5, 0.29}, Hsv{120.0, 0.5, 0.81}})
    EXPECT_FALSE(fits(colours, outside));
}

}  // namespace
}  // namespace azimuth
