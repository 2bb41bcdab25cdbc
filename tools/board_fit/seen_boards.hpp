#pragma once
// A folder of images, looked through for a chessboard.

#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/board_fit/board_fit.hpp"
#include "tools/calibrate/read_image.hpp"

namespace azimuth {

struct SeenBoards {
  FrameFormat format;                    ///< of all images, in grey
  std::vector<BoardSighting> sightings;  ///< at most one an image
  std::vector<std::filesystem::path> images;
  std::vector<std::filesystem::path> without;  ///< those in which the board was not found whole
  /// In some of them, a board of another number of corners was found; the one most often seen. 0 columns: none.
  Chessboard other = {};
};

/// Refuses an image that cannot be read, and one of another size than those before it.
FileResult<SeenBoards> look_for_boards(const std::vector<std::filesystem::path>& images, const Chessboard& board);

/// In gray8, without padding.
ImageFile in_grey(const ImageFile& image);

}  // namespace azimuth
