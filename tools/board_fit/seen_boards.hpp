#pragma once
// Searches a list of images for a chessboard.

#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/board_fit/board_fit.hpp"
#include "tools/calibrate/read_image.hpp"

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

}  // namespace azimuth
