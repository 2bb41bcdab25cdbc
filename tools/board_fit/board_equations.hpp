#pragma once
// Internal to tools/board_fit, and to its test.

#include "tools/board_fit/board_fit.hpp"
#include "tools/lens_fit/robust_fit.hpp"

namespace azimuth {

/// Corners are whitened by at.sigma_px. Unknowns: those of the lens, then of each board how it turns and moves, in the
/// camera's frame.
FitEquations board_equations(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                             const BoardSolution& at);
BoardSolution board_moved(BoardSolution from, const Eigen::VectorXd& by);

}  // namespace azimuth
