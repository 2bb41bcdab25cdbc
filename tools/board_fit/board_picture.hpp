#pragma once
#include "tools/board_fit/board_fit.hpp"
#include "tools/lens_fit/residual_picture.hpp"

namespace azimuth {

/// residual_picture() of the corners of all boards, drawn on one of the images.
PlotCanvas board_picture(const ImageView& image, const Chessboard& board, const std::vector<BoardSighting>& sightings,
                         const BoardSolution& solution);

}  // namespace azimuth
