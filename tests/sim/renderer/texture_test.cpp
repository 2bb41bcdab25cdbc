#include "sim/renderer/texture.hpp"

#include <gtest/gtest.h>

#include "sim/renderer/passes.hpp"

namespace azimuth {
namespace {

TEST(PackedColour, MixGoesFromOneToTheOther) {
  const PackedColour a = colour(10, 200, 30), b = colour(250, 0, 130);
  EXPECT_EQ(mix(a, b, 0), a);
  EXPECT_EQ(mix(a, b, 256), b);
  EXPECT_EQ(mix(a, b, 128), colour(130, 100, 80));
  EXPECT_EQ(dim(a, 128), colour(5, 100, 15));
  EXPECT_EQ(mix(colour(255, 255, 255), colour(255, 255, 255), 77), colour(255, 255, 255));
}

/// 4 x 4 texels of 1 m with the value 16 * row + column in red.
Texture ramp() {
  std::vector<PackedColour> texels;
  for (unsigned y = 0; y < 4; ++y) {
    for (unsigned x = 0; x < 4; ++x) texels.push_back(colour(16 * y + x, 0, 0));
  }
  return {texels, 4.0};
}

TEST(Texture, InterpolatesAndRepeats) {
  const Texture texture = ramp();
  EXPECT_EQ(red_of(texture.at(1.0F, 2.0F, 0)), 33U);
  EXPECT_EQ(red_of(texture.at(1.0F, 2.5F, 0)), 41U);
  EXPECT_EQ(red_of(texture.at(5.0F, -2.0F, 0)), 33U);
  EXPECT_EQ(red_of(texture.at(-3.0F, 402.0F, 0)), 33U);
}

TEST(Texture, SmallerSizesAreAverages) {
  const Texture texture = ramp();
  EXPECT_EQ(red_of(texture.at(0.0F, 0.0F, 1)), (0U + 1 + 16 + 17 + 2) / 4);
  EXPECT_NEAR(red_of(texture.at(0.3F, 0.7F, 2)), 25.5, 1.0);
}

TEST(Texture, LevelGrowsWithTheFootprint) {
  const Texture texture = ramp();
  EXPECT_EQ(texture.level(0.01F), 0U);
  EXPECT_EQ(texture.level(1.5F), 1U);
  EXPECT_EQ(texture.level(1e9F), 2U) << "never beyond the smallest";
}

TEST(Procedural, SeedsDecide) {
  const auto look = [](const Texture& texture) {
    std::vector<PackedColour> seen;
    for (float x = 0.0F; x < 1.0F; x += 0.05F) {
      for (float y = 0.0F; y < 1.0F; y += 0.05F) seen.push_back(texture.at(x, y, 0));
    }
    return seen;
  };
  EXPECT_EQ(look(poster_texture(7, 1.0)), look(poster_texture(7, 1.0)));
  EXPECT_NE(look(poster_texture(7, 1.0)), look(poster_texture(8, 1.0)));
  EXPECT_NE(look(floor_texture(1)), look(floor_texture(2)));
  EXPECT_NE(look(plaster_texture(1)), look(plaster_texture(2)));
}

TEST(Surface, DecalsCoverExactlyTheirPart) {
  const PackedColour grey = colour(100, 100, 100), white = colour(255, 255, 255);
  Decal lamp{1.0F, 1.0F, 2.0F, 1.5F, std::nullopt, white};
  const Surface surface(Texture({grey}, 1.0), {lamp}, 256);
  EXPECT_EQ(surface.at(1.5F, 1.25F, 0.1F, 0.1F), white);
  EXPECT_EQ(surface.at(0.5F, 1.25F, 0.1F, 0.1F), grey);
  EXPECT_EQ(surface.at(-50.0F, 80.0F, 0.1F, 0.1F), grey);
  EXPECT_NEAR(red_of(surface.at(1.0F, 1.25F, 0.1F, 0.1F)), 177, 2) << "half of it";
  EXPECT_NEAR(red_of(surface.at(2.0F, 1.5F, 0.1F, 0.1F)), 100 + 155 / 4.0, 2) << "a corner";
  EXPECT_NEAR(red_of(surface.at(1.5F, 1.25F, 0.1F, 1.0F)), 177, 2) << "a pixel higher than the lamp";
}

TEST(Surface, BrightnessIsNotForLights) {
  const PackedColour white = colour(255, 255, 255);
  const Surface dark(Texture({white}, 1.0), {{1.0F, 1.0F, 2.0F, 2.0F, std::nullopt, white}}, 26);
  EXPECT_LT(red_of(dark.at(0.0F, 0.0F, 0.01F, 0.01F)), 30U);
  EXPECT_EQ(dark.at(1.5F, 1.5F, 0.01F, 0.01F), white);
}

}  // namespace
}  // namespace azimuth
