#include "tools/plot/bearing_residuals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

std::vector<PlottedResidual> spread_residuals(int count, double sigmas) {
  std::vector<PlottedResidual> residuals;
  for (int i = 0; i < count; ++i) residuals.push_back({0.001 * i, sigmas * (i % 21 - 10) / 10.0});
  return residuals;
}

std::string svg_of(const BearingResiduals& residuals) {
  return drawn_residuals(residuals, PlotFormat::svg).file_bytes().value();
}

TEST(BearingResiduals, ShareWithinCountsBothSides) {
  EXPECT_DOUBLE_EQ(share_within({{0.0, -3.0}, {0.0, -1.0}, {0.0, 2.0}, {0.0, 2.1}}, 2.0), 0.5);
  EXPECT_EQ(share_within({}, 2.0), 0.0);
}

TEST(BearingResiduals, DrawsBeforeAndAfterEachInItsColour) {
  const std::string both = svg_of({"r", spread_residuals(200, 3.0), spread_residuals(200, 1.0)});
  EXPECT_THAT(both, testing::HasSubstr("stroke:rgb(83.5%,36.9%,0%)"));
  EXPECT_THAT(both, testing::HasSubstr("stroke:rgb(0%,62%,45.1%)"));
  EXPECT_NE(both, svg_of({"r", spread_residuals(200, 3.0), spread_residuals(200, 2.0)}));
}

TEST(BearingResiduals, ManyResidualsTakeFewBytes) {
  EXPECT_LT(svg_of({"r", spread_residuals(100'000, 3.0), spread_residuals(100'000, 1.0)}).size(), 400'000U);
}

TEST(BearingResiduals, SurvivesNoneAndThoseFarOutside) {
  EXPECT_THAT(svg_of({"r", {}, {}}), testing::HasSubstr("</svg>"));
  const double far = std::numeric_limits<double>::max();
  const std::string drawn = svg_of({"r", {{3.14159265358979, far}, {-3.14159265358979, -far}}, {{10.0, 1e9}}});
  EXPECT_THAT(drawn, testing::Not(testing::HasSubstr("nan")));
  EXPECT_THAT(drawn, testing::Not(testing::HasSubstr("inf")));
}

}  // namespace
}  // namespace azimuth
