#include "tools/board_fit/board_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/rendered_boards.hpp"

namespace azimuth {
namespace {

struct Boards {
  std::vector<Eigen::Isometry3d> T_camera_board;
  std::vector<BoardSighting> sightings;
};

Boards boards_seen(std::size_t count, double sigma_px, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const CameraModel camera = test::camera_185();
  Boards boards;
  for (std::size_t i = 0; i < count; ++i) {
    boards.T_camera_board.push_back(test::board_somewhere(camera, test::kSide_px, test::kChessboard, 1.45, random));
    boards.sightings.push_back(
        {i, test::corners_of(camera, test::kChessboard, boards.T_camera_board.back(), sigma_px, random)});
  }
  return boards;
}

Lens wrong_lens() {
  Lens lens = test::lens_185();
  lens.axes.centre_px = {383.5, 383.5};
  lens.c = {-0.68, 0.40, 0.0, 0.0};
  return lens;
}

TEST(BoardFit, EquationsAreThoseOfDifferences) {
  const Boards boards = boards_seen(3, 0.5, 1);
  const BoardSolution at{
      .lens = wrong_lens(), .T_camera_board = boards.T_camera_board, .sigma_px = 1e4, .error_px = {}, .fits = {}};
  const FitEquations equations = board_equations(test::kChessboard, boards.sightings, at);
  constexpr double kStep = 1e-6;
  for (Eigen::Index k = 0; k < equations.J.cols(); ++k) {
    if (k == kLensNumbers - 1) continue;  // this parameter is held by an equation of its own
    const Eigen::VectorXd off = kStep * Eigen::VectorXd::Unit(equations.J.cols(), k);
    const Eigen::VectorXd slope = (board_equations(test::kChessboard, boards.sightings, board_moved(at, off)).e -
                                   board_equations(test::kChessboard, boards.sightings, board_moved(at, -off)).e) /
                                  (2.0 * kStep);
    const Eigen::VectorXd column = equations.J.col(k);
    EXPECT_LT((column - slope).norm(), 1e-4 * std::max(1e-2, slope.norm())) << k;
  }
}

TEST(BoardFit, APoseFollowsFromRays) {
  const Boards boards = boards_seen(20, 0.0, 2);
  for (std::size_t i = 0; i < boards.sightings.size(); ++i) {
    const auto pose = board_pose(test::lens_185(), test::kChessboard, boards.sightings[i].corners);
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->isApprox(boards.T_camera_board[i], 1e-6));
  }
}

TEST(BoardFit, FindsALensFromAWrongOne) {
  const Boards boards = boards_seen(15, 0.1, 3);
  const auto start = board_start({wrong_lens()}, test::kChessboard, boards.sightings);
  ASSERT_TRUE(start);
  const auto found = fit_boards(test::kChessboard, boards.sightings, *start);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->sigma_px, 0.1, 0.01);
  EXPECT_GT(found->fitting(), 0.98);
  const LensVector off = found->lens.numbers() - test::lens_185().numbers();
  for (int k = 0; k < kLensNumbers - 1; ++k) EXPECT_LT(std::abs(off[k]), 3.5 * std::sqrt(found->covariance(k, k))) << k;
  EXPECT_NEAR(off[kLensNumbers - 1], 0.0, 1e-9);
}

TEST(BoardFit, ABoardThatIsNoneOfItIsNotBelieved) {
  Boards boards = boards_seen(15, 0.1, 4);
  for (Pixel& corner : boards.sightings.front().corners)
    corner = Pixel(corner.y(), 40.0 * std::sin(corner.x()) + 300.0);
  const auto start = board_start({wrong_lens()}, test::kChessboard, boards.sightings);
  ASSERT_TRUE(start);
  const auto found = fit_boards(test::kChessboard, boards.sightings, *start);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->fitting(), 14.0 / 15.0, 0.02);
  const Pixel off_px = found->lens.axes.centre_px - test::lens_185().axes.centre_px;
  for (int k = 0; k < 2; ++k) EXPECT_LT(std::abs(off_px[k]), 3.5 * std::sqrt(found->covariance(k, k))) << k;
}

}  // namespace
}  // namespace azimuth
