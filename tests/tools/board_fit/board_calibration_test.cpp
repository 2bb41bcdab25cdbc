#include "tools/board_fit/board_calibration.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/rendered_boards.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

/// Simulated corners of chessboards in images of the 185 degree lens.
SeenBoards seen_within(double farthest_rad, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const CameraModel camera = test::camera_185();
  SeenBoards seen;
  seen.format = packed_format(PixelFormat::gray8, test::kSide_px, test::kSide_px);
  for (std::size_t i = 0; i < count; ++i) {
    const auto pose = test::board_somewhere(camera, test::kSide_px, test::kChessboard, farthest_rad, random);
    seen.images.emplace_back(std::to_string(i) + ".png");
    seen.sightings.push_back({i, test::corners_of(camera, test::kChessboard, pose, 0.08, random)});
  }
  return seen;
}

std::string problem_of(const SeenBoards& seen, const Chessboard& board = test::kChessboard) {
  std::string problem;
  EXPECT_FALSE(calibrate_by_boards(board, seen, unknown_fisheye(seen.format), std::nullopt, problem));
  return problem;
}

class BoardCalibrationStarts : public testing::TestWithParam<double> {};

TEST_P(BoardCalibrationStarts, FindTheLensFromTheImagesAndFromAFieldOfView) {
  const SeenBoards seen = seen_within(1.45, 14, 1);
  const auto field_of_view_rad = GetParam() > 0.0 ? std::optional(degrees_to_rad(GetParam())) : std::nullopt;
  std::string problem;
  const auto found =
      calibrate_by_boards(test::kChessboard, seen, unknown_fisheye(seen.format), field_of_view_rad, problem);
  ASSERT_TRUE(found) << problem;
  const Lens& lens = found->solution.lens;
  EXPECT_LT((lens.axes.centre_px - test::lens_185().axes.centre_px).norm(), 0.3);
  for (double theta = 0.1; theta < found->theta_seen_rad; theta += 0.1)
    EXPECT_NEAR(radius_px(lens, theta), radius_px(test::lens_185(), theta),
                3.5 * sigma_radius_px(lens, found->solution.covariance, theta))
        << theta;
  EXPECT_GT(found->theta_max_rad, 1.4);
  EXPECT_LT(found->theta_max_rad, found->theta_seen_rad + 0.03);
}

INSTANTIATE_TEST_SUITE_P(Degrees, BoardCalibrationStarts, testing::Values(0.0, 120.0, 185.0, 230.0),
                         [](const auto& use) { return std::to_string(static_cast<int>(use.param)); });

TEST(BoardCalibration, TooFewBoardsAreSaidToBe) {
  SeenBoards seen = seen_within(1.45, 4, 2);
  EXPECT_THAT(problem_of(seen), HasSubstr("was found in 4 of 4 images, and it takes 5 or more"));
  seen.images.emplace_back("dark.png");
  seen.without.emplace_back("dark.png");
  EXPECT_THAT(problem_of(seen), HasSubstr("not found in dark.png"));
  seen.other = {.columns = 8, .rows = 5};
  EXPECT_THAT(problem_of(seen), HasSubstr("one of 8x5 in others: --chessboard counts corners inside"));
}

TEST(BoardCalibration, BoardsInTheMiddleTellNothingOfTheRim) {
  EXPECT_THAT(problem_of(seen_within(0.35, 14, 3)), HasSubstr("in the image's middle only"));
}

TEST(BoardCalibration, BoardsSeenSquarelyDoNotTellHowLongTheLensIs) {
  SeenBoards seen = seen_within(1.45, 0, 4);
  const CameraModel camera = test::camera_185();
  std::mt19937_64 random(4);
  for (int i = 0; i < 8; ++i) {  // all boards are perpendicular to the optical axis
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.7 * i, Eigen::Vector3d::UnitZ()));
    pose.translation() = Eigen::Vector3d(0.35 * std::cos(0.8 * i), 0.35 * std::sin(0.8 * i), 0.3);
    seen.images.emplace_back(std::to_string(i));
    seen.sightings.push_back({as_size(i), test::corners_of(camera, test::kChessboard, pose, 0.3, random)});
  }
  const std::string problem = problem_of(seen);
  EXPECT_THAT(problem, testing::AnyOf(HasSubstr("tilt the board"), HasSubstr("known to"))) << problem;
}

TEST(BoardCalibration, CornersThatFitNoLensAreSaidTo) {
  SeenBoards seen = seen_within(1.45, 10, 5);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anywhere(100.0, 600.0);
  for (std::size_t i = 0; i < seen.sightings.size(); i += 2)
    for (Pixel& corner : seen.sightings[i].corners) corner = {anywhere(random), anywhere(random)};
  EXPECT_THAT(problem_of(seen), HasSubstr("fit any lens"));
}

}  // namespace
}  // namespace azimuth
