#include <gtest/gtest.h>

#include "slam/perception/colour/colour_perception.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

constexpr int kAreaWidth_px = 41, kAreaHeight_px = 31;

ImageMask mask() { return {{{20.0, 15.0}}, {4.0, 14.0, {{{18.0, 0.0}, {22.0, 0.0}, {22.0, 16.0}, {18.0, 16.0}}}}}; }

class SampleSizes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sides, SampleSizes, testing::Values(1, 2), test::PrintedName());

TEST_P(SampleSizes, ASampleIsVisibleWhenAllItsPixelsAre) {
  const int side = GetParam();
  const VisibleArea area(mask(), kAreaWidth_px, kAreaHeight_px, side);
  int visible = 0;
  for (int row = -1; row <= kAreaHeight_px / side; ++row)
    for (int column = -1; column <= kAreaWidth_px / side; ++column) {
      bool all = column >= 0 && row >= 0 && column < kAreaWidth_px / side && row < kAreaHeight_px / side;
      for (int k = 0; k < side * side; ++k) {
        const Eigen::Vector2i pixel(column * side + k % side, row * side + k / side);
        all = all && mask().visible(pixel.cast<double>());
      }
      ASSERT_EQ(area.contains(column, row), all) << column << ", " << row;
      visible += all ? 1 : 0;
    }
  EXPECT_GT(visible, 50);
}

TEST_P(SampleSizes, SpansHoldExactlyTheVisibleSamples) {
  const VisibleArea area(mask(), kAreaWidth_px, kAreaHeight_px, GetParam());
  int in_spans = 0, visible = 0;
  for (const VisibleSpan& span : area.spans()) {
    EXPECT_LT(span.begin, span.end);
    for (int column = span.begin; column < span.end; ++column) EXPECT_TRUE(area.contains(column, span.row));
    EXPECT_FALSE(area.contains(span.begin - 1, span.row));
    EXPECT_FALSE(area.contains(span.end, span.row));
    in_spans += span.end - span.begin;
  }
  for (int row = 0; row < kAreaHeight_px; ++row)
    for (int column = 0; column < kAreaWidth_px; ++column) visible += area.contains(column, row) ? 1 : 0;
  EXPECT_EQ(in_spans, visible);
}

}  // namespace
}  // namespace azimuth
