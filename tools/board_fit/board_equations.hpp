#pragma once
// Internal to tools/board_fit and its test.

#include "tools/board_fit/board_fit.hpp"
#include "tools/lens_fit/robust_fit.hpp"

namespace azimuth {

/// Corners are whitened by at.sigma_px. Unknowns: the lens parameters, then for each board its rotation and translation
/// in the camera's frame.
FitEquations board_equations(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                             const BoardSolution& at);
BoardSolution board_moved(BoardSolution from, const Eigen::VectorXd& by);

}  // namespace azimuth
