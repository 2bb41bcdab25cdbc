#pragma once
// azimuth calibrate fisheye --chessboard: the lens from images of a chessboard.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/azimuth/recorded_drive.hpp"

namespace azimuth {

struct ChessboardOptions {
  std::vector<std::filesystem::path> images;  ///< files, folders of them, or run folders
  std::filesystem::path rig;                  ///< empty: that of a run folder, if there is one
  std::string board;                          ///< COLUMNSxROWS
  std::optional<double> square_m, field_of_view_rad;
  std::size_t most_images = 60;
  CalibrationOutputs outputs;
};

void calibrate_by_chessboard(const ChessboardOptions& options);

}  // namespace azimuth
