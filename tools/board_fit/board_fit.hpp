#pragma once
// Estimates the lens and the poses of a chessboard in one least-squares fit (mathematics VI.29).

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/board_fit/chessboard.hpp"
#include "tools/lens_fit/lens.hpp"
#include "tools/lens_fit/robust_fit.hpp"

namespace azimuth {

/// All corners of the board in one image.
struct BoardSighting {
  std::size_t image = 0;
  std::vector<Pixel> corners;  ///< in the order of Chessboard::corner()
};

struct BoardSolution {
  Lens lens;
  std::vector<Eigen::Isometry3d> T_camera_board;  ///< for each BoardSighting; the camera's z is along the lens axis

  // Filled by fit_boards(). Corners are ordered board by board.
  LensCovariance covariance = LensCovariance::Zero();  ///< 0 for the unobservable rotation about the axis
  double sigma_px = 1.0;                               ///< estimated noise of a corner along u and along v
  std::vector<double> error_px;                        ///< residual of each corner; NaN if it has no image
  std::vector<bool> fits;                              ///< for each corner: robust weight at least one half

  double rms_px() const;   ///< root mean square of the residuals that fit
  double fitting() const;  ///< share of the corners that fit
};

/// The equations of the fit, for its test. Corners are whitened by at.sigma_px. Unknowns: the lens parameters, then for
/// each board its rotation and translation in the camera's frame.
FitEquations board_equations(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                             const BoardSolution& at);
BoardSolution board_moved(BoardSolution from, const Eigen::VectorXd& by);

/// Approximate pose of a board from its corners, by a homography from the board to viewing rays. Nothing if there is
/// none.
std::optional<Eigen::Isometry3d> board_pose(const Lens& lens, const Chessboard& board,
                                            const std::vector<Pixel>& corners);

/// The initial solution: the lens among `starts` with the smallest residuals when each board is at its board_pose().
/// Nothing if no lens sees all boards.
std::optional<BoardSolution> board_start(const std::vector<Lens>& starts, const Chessboard& board,
                                         const std::vector<BoardSighting>& sightings);

/// Fits from `start` with the Cauchy kernel on corners. The noise of the corners is estimated as well. The rotation
/// about the lens axis is fixed. Nothing if the corners do not determine the unknowns. Deterministic.
std::optional<BoardSolution> fit_boards(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                                        const BoardSolution& start);

}  // namespace azimuth
