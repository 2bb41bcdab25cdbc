#pragma once
// A fisheye's lens from images of a chessboard.

#include <optional>
#include <string>

#include "slam/estimator/rig.hpp"
#include "tools/board_fit/seen_boards.hpp"

namespace azimuth {

struct BoardCalibration {
  BoardSolution solution;
  double rim_px = 0.0;          ///< of the image's circle, as far as is known
  double reach_px = 0.0;        ///< from the centre, to the farthest corner that fits
  double theta_seen_rad = 0.0;  ///< as far from the axis
  double theta_max_rad = 0.0;   ///< the lens is given up to here: no farther, and as far as it grows
  Rig rig;                      ///< as it was, with that lens
};

/// `rig` says what is known beforehand: size of the images, mask, direction of the azimuth, and perhaps a lens to begin
/// with. Without, or with `field_of_view_rad` (full angle within the image's circle), equidistant ones are tried.
/// Nothing, and in `problem` one sentence that says why, when the images cannot tell. Deterministic.
std::optional<BoardCalibration> calibrate_by_boards(const Chessboard& board, const SeenBoards& seen, const Rig& rig,
                                                    std::optional<double> field_of_view_rad, std::string& problem);

/// The rig of a camera of which nothing is known but its images: it looks up, with the heading up in the image.
Rig unknown_fisheye(const FrameFormat& format);

}  // namespace azimuth
