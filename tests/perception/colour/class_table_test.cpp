#include "slam/perception/colour/class_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <set>

namespace azimuth {
namespace {

/// Visits every `step`-th value of each of three samples.
template <class Visit>
void visit_colours(int step, Visit visit) {
  for (int a = 0; a < 256; a += step)
    for (int b = 0; b < 256; b += step)
      for (int c = 0; c < 256; c += step)
        visit(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c));
}

TEST(ClassTable, HoldsTheClassOfEachCellsMiddle) {
  const ColourSettings settings;
  const ClassTable rgb(settings, SampleSpace::rgb), yuv(settings, SampleSpace::yuv);
  const auto middle = [](std::uint8_t low) { return static_cast<std::uint8_t>(low + 2); };
  std::set<int> seen;
  visit_colours(4, [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const Rgb colour{middle(a), middle(b), middle(c)};
    ASSERT_EQ(rgb.at(a, b, c), class_of(settings, colour));
    ASSERT_EQ(yuv.at(a, b, c), class_of(settings, rgb_of_yuv(colour.red, colour.green, colour.blue, true)));
    seen.insert(rgb.at(a, b, c));
  });
  EXPECT_EQ(seen.size(), settings.classes.size() + 1) << "every class, and none";
}

TEST(ClassTable, NothingBelowTheLeastChromaHasAClass) {
  const ColourSettings settings;
  const ClassTable rgb(settings, SampleSpace::rgb), yuv(settings, SampleSpace::yuv);
  EXPECT_GT(rgb.least_chroma(), 0);
  EXPECT_GT(yuv.least_chroma(), 0);
  visit_colours(3, [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const auto [low, high] = std::minmax({a, b, c});
    const bool grey_rgb = high - low < rgb.least_chroma();
    const bool grey_yuv = std::max(std::abs(b - 128), std::abs(c - 128)) < yuv.least_chroma();
    ASSERT_TRUE(!grey_rgb || rgb.at(a, b, c) == 0);
    ASSERT_TRUE(!grey_yuv || yuv.at(a, b, c) == 0);
  });
}

TEST(ClassTable, AClassOfGreysPassesNothingOver) {
  ColourSettings settings;
  settings.classes = {{.name = "any", .saturation_min = 0.0, .value_min = 0.0}};
  const ClassTable rgb(settings, SampleSpace::rgb), yuv(settings, SampleSpace::yuv);
  EXPECT_EQ(rgb.least_chroma(), 0);
  EXPECT_EQ(yuv.least_chroma(), 0);
  EXPECT_EQ(rgb.at(77, 77, 77), 1);
}

TEST(ClassTable, TheFirstClassThatFitsWins) {
  ColourSettings settings;
  settings.classes = {{.name = "warm", .hue_from_deg = 300, .hue_to_deg = 90}, {.name = "all"}};
  EXPECT_EQ(class_of(settings, {200, 20, 20}), 1);
  EXPECT_EQ(class_of(settings, {20, 20, 200}), 2);
  settings.classes.clear();
  EXPECT_EQ(class_of(settings, {200, 20, 20}), 0);
  EXPECT_EQ(ClassTable(settings, SampleSpace::rgb).least_chroma(), 255);
}

}  // namespace
}  // namespace azimuth
