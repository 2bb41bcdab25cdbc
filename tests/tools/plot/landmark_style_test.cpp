#include "tools/plot/landmark_style.hpp"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace azimuth {
namespace {

std::tuple<double, double, double, int> look(const LandmarkStyle& style) {
  return {style.colour.red, style.colour.green, style.colour.blue, static_cast<int>(style.marker)};
}

TEST(LandmarkStyle, NoTwoKindsLookTheSame) {
  std::set<std::tuple<double, double, double, int>> looks;
  for (std::size_t i = 0; i < 32; ++i) looks.insert(look(landmark_style({"", std::nullopt}, i)));
  EXPECT_EQ(looks.size(), 32U);
}

TEST(LandmarkStyle, ColourIsNearTheThingsOwn) {
  const Colour red = landmark_style({"red", 0.0}, 0).colour, green = landmark_style({"green", 125.0}, 2).colour,
               blue = landmark_style({"blue", 230.0}, 3).colour, yellow = landmark_style({"yellow", 55.0}, 1).colour;
  EXPECT_GT(red.red, red.green + red.blue);
  EXPECT_GT(green.green, green.red + 0.1);
  EXPECT_GT(blue.blue, blue.red + 0.5);
  EXPECT_GT(yellow.red + yellow.green, 1.5);
  EXPECT_EQ(landmark_style({"also red", 359.0}, 1).colour.red, red.red);
}

TEST(LandmarkStyle, AlikeInHueAreTwoShapes) {
  EXPECT_NE(landmark_style({"red", 0.0}, 0).marker, landmark_style({"pink", 5.0}, 1).marker);
}

}  // namespace
}  // namespace azimuth
