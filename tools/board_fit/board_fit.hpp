#pragma once
// Lens and poses of a chessboard in one least-squares fit (SPEC VI.29).

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/board_fit/chessboard.hpp"
#include "tools/lens_fit/lens.hpp"

namespace azimuth {

/// All corners of the board in one image.
struct BoardSighting {
  std::size_t image = 0;
  std::vector<Pixel> corners;  ///< as Chessboard::corner counts them
};

struct BoardSolution {
  Lens lens;
  std::vector<Eigen::Isometry3d> T_camera_board;  ///< of each sighting; the camera's z along its axis

  // Filled by fit_boards(); corners follow each other board by board.
  LensCovariance covariance = LensCovariance::Zero();  ///< 0 for the turn about the axis, which no board tells
  double sigma_px = 1.0;                               ///< of a corner along u and along v, as the residuals have it
  std::vector<double> error_px;                        ///< of each corner; NaN: the lens has no image of it
  std::vector<bool> fits;                              ///< whether it counts in full, more or less

  double rms_px() const;   ///< of what fits, as distances in the image
  double fitting() const;  ///< share of the corners
};

/// The pose at which a lens sees a board nearly so, by a homography from the board to rays. Nothing: there is none.
std::optional<Eigen::Isometry3d> board_pose(const Lens& lens, const Chessboard& board,
                                            const std::vector<Pixel>& corners);

/// A lens to begin with: that of `starts` whose boards are nearest to where they were seen, each at its board_pose().
/// Nothing: none of them sees all boards.
std::optional<BoardSolution> board_start(const std::vector<Lens>& starts, const Chessboard& board,
                                         const std::vector<BoardSighting>& sightings);

/// Fits from `start`, with Cauchy's kernel on corners, whose errors are as large as they turn out to be. The turn about
/// the axis stays as it was. Nothing: what is there does not determine the unknowns. Deterministic.
std::optional<BoardSolution> fit_boards(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                                        const BoardSolution& start);

}  // namespace azimuth
