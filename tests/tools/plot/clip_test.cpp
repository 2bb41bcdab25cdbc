#include "tools/plot/clip.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

const Box kBox{{0.0, 0.0}, {10.0, 5.0}};

TEST(Clipped, LeavesWhatIsInsideAlone) {
  const PlotLine line{{1.0, 1.0}, {2.0, 4.0}, {9.0, 4.5}};
  EXPECT_EQ(clipped(line, kBox), std::vector<PlotLine>{line});
}

TEST(Clipped, EndsAtTheBorders) {
  const auto pieces = clipped(PlotLine{{-5.0, 2.0}, {15.0, 2.0}}, kBox);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0], (PlotLine{{0.0, 2.0}, {10.0, 2.0}})) << "straight through, both ends outside";
}

TEST(Clipped, ComesBackAsAnotherPiece) {
  const auto pieces = clipped(PlotLine{{5.0, 1.0}, {5.0, 9.0}, {8.0, 9.0}, {8.0, 1.0}, {9.0, 1.0}}, kBox);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0], (PlotLine{{5.0, 1.0}, {5.0, 5.0}}));
  EXPECT_EQ(pieces[1], (PlotLine{{8.0, 5.0}, {8.0, 1.0}, {9.0, 1.0}}));
}

TEST(Clipped, HasNothingOfWhatPassesBy) {
  EXPECT_TRUE(clipped(PlotLine{{-1.0, 4.0}, {4.0, 9.0}}, kBox).empty()) << "past a corner";
  EXPECT_TRUE(clipped(PlotLine{{-1.0, -1.0}, {11.0, -1.0}}, kBox).empty());
  EXPECT_TRUE(clipped(PlotLine{}, kBox).empty());
  EXPECT_TRUE(clipped(PlotLine{{1.0, 1.0}}, kBox).empty());
}

TEST(Clipped, LiftsThePenWhereThereIsNoPlace) {
  const double far = 1e300;
  const auto pieces =
      clipped(PlotLine{{1.0, 1.0}, {2.0, 1.0}, {NAN, 1.0}, {3.0, 1.0}, {4.0, 1.0}, {far, -far}, {5.0, 1.0}}, kBox);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0], (PlotLine{{1.0, 1.0}, {2.0, 1.0}}));
  EXPECT_EQ(pieces[1], (PlotLine{{3.0, 1.0}, {4.0, 1.0}}));
}

TEST(Thinned, KeepsEndsAndEveryStep) {
  PlotLine line;
  for (int i = 0; i <= 100; ++i) line.emplace_back(0.01 * i, 0.0);
  const PlotLine kept = thinned(line, 0.25);
  EXPECT_EQ(kept.size(), 5U);
  EXPECT_EQ(kept.front(), line.front());
  EXPECT_EQ(kept.back(), line.back());
  EXPECT_TRUE(thinned(PlotLine{}, 1.0).empty());
}

}  // namespace
}  // namespace azimuth
