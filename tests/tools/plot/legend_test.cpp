#include "tools/plot/legend.hpp"

#include <array>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

TEST(Flow, BeginsARowWhereTheNextDoesNotFit) {
  const auto places = flow(std::array{40.0, 50.0, 30.0, 200.0, 10.0}, 100.0);
  ASSERT_EQ(places.size(), 5U);
  EXPECT_EQ(places[1].row, 0U);
  EXPECT_EQ(places[1].left_px, 40.0);
  EXPECT_EQ(places[2].row, 1U);
  EXPECT_EQ(places[2].left_px, 0.0);
  EXPECT_EQ(places[3].row, 2U) << "wider than a row: one to itself";
  EXPECT_EQ(places[4].row, 3U);
  EXPECT_TRUE(flow({}, 100.0).empty());
}

}  // namespace
}  // namespace azimuth
