#pragma once
// Searches images for a chessboard, and calibrates the lens of a fisheye camera from them.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/board_fit/board_fit.hpp"
#include "tools/calibrate/image_files.hpp"

namespace azimuth {

struct SeenBoards {
  FrameFormat format;                    ///< format of all images after conversion to grey
  std::vector<BoardSighting> sightings;  ///< at most one per image
  std::vector<std::filesystem::path> images;
  std::vector<std::filesystem::path> without;  ///< images in which the complete board was not found
  /// The board with a different number of corners that most often appears in `without`. 0 columns if there is none.
  Chessboard other = {};
};

/// Fails if an image cannot be read or if its size differs from that of the previous images.
FileResult<SeenBoards> look_for_boards(const std::vector<std::filesystem::path>& images, const Chessboard& board);

/// Converts an image to gray8 without padding.
ImageFile in_grey(const ImageFile& image);

struct BoardCalibration {
  BoardSolution solution;
  double rim_px = 0.0;          ///< radius of the image circle as far as known
  double reach_px = 0.0;        ///< distance from the centre to the farthest corner that fits
  double theta_seen_rad = 0.0;  ///< angle from the axis at reach_px
  double theta_max_rad = 0.0;   ///< limit of the lens: near theta_seen_rad, where theta still grows with the radius
  Rig rig;                      ///< the input rig with the calibrated lens
};

/// `rig` contains the prior knowledge: size of the images, mask, azimuth direction, and optionally an initial lens. If
/// there is no initial lens, or if `field_of_view_rad` is given (full angle within the image circle), the fit starts
/// from equidistant lenses. If the images do not determine the lens, the result is empty and `problem` has one sentence
/// with the reason. Deterministic.
std::optional<BoardCalibration> calibrate_by_boards(const Chessboard& board, const SeenBoards& seen, const Rig& rig,
                                                    std::optional<double> field_of_view_rad, std::string& problem);

/// The rig of a camera of which only the image format is known. The camera looks up; the heading points up in the
/// image.
Rig unknown_fisheye(const FrameFormat& format);

}  // namespace azimuth
