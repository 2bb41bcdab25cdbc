#include "tools/board_fit/chessboard.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/support/rendered_boards.hpp"

namespace azimuth {
namespace {

class FoundChessboards : public testing::Test {
 protected:
  test::GreyImage image_of(const Eigen::Isometry3d& pose) {
    return test::rendered(camera_, test::kSide_px, test::kChessboard, pose, 2.0, random_);
  }
  /// The largest distance from a found corner to the nearest true corner [px]. The end at which the numbering of the
  /// corners starts does not matter.
  double farthest_off_px(const std::vector<Pixel>& corners, const Eigen::Isometry3d& pose) {
    const std::vector<Pixel> truth = test::corners_of(camera_, test::kChessboard, pose, 0.0, random_);
    double most_px = 0.0;
    for (const Pixel& corner : corners) {
      double least_px = 1e9;
      for (const Pixel& each : truth) least_px = std::min(least_px, (corner - each).norm());
      most_px = std::max(most_px, least_px);
    }
    return most_px;
  }
  CameraModel camera_ = test::camera_185();
  std::mt19937_64 random_{5};
};

TEST_F(FoundChessboards, AreWhereTheyWereRenderedNearTheRimAsWell) {
  for (int i = 0; i < 6; ++i) {
    const Eigen::Isometry3d pose = test::board_somewhere(camera_, test::kSide_px, test::kChessboard, 1.5, random_);
    const test::GreyImage image = image_of(pose);
    const auto corners = find_chessboard(image.view(), test::kChessboard);
    ASSERT_TRUE(corners) << i;
    EXPECT_LT(farthest_off_px(*corners, pose), 0.4) << i;
  }
}

TEST_F(FoundChessboards, HaveAsManyCornersAsTheyHave) {
  const Eigen::Isometry3d pose = test::board_somewhere(camera_, test::kSide_px, test::kChessboard, 0.5, random_);
  const test::GreyImage image = image_of(pose);
  EXPECT_FALSE(find_chessboard(image.view(), {.columns = 10, .rows = 7}));
  EXPECT_FALSE(find_chessboard(image.view(), {.columns = 9, .rows = 7}));
  const auto any = any_chessboard(image.view());
  ASSERT_TRUE(any);
  EXPECT_EQ(std::max(any->columns, any->rows), 9);
  EXPECT_EQ(std::min(any->columns, any->rows), 6);
}

TEST_F(FoundChessboards, AreNoneWhereThereIsNone) {
  const std::vector<std::byte> grey(as_size(test::kSide_px) * as_size(test::kSide_px), std::byte{90});
  const ImageView view{packed_format(PixelFormat::gray8, test::kSide_px, test::kSide_px), grey};
  EXPECT_FALSE(find_chessboard(view, test::kChessboard));
  EXPECT_FALSE(any_chessboard(view));
}

}  // namespace
}  // namespace azimuth
