#pragma once
// azimuth calibrate fisheye --chessboard: the lens from images of a chessboard.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/image.hpp"
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

/// The rig of the file, which has to be of a fisheye with such images; without a file one of which nothing is known but
/// their size.
Rig rig_of_fisheye_or_refuse(const std::filesystem::path& file, const FrameFormat& format);

void calibrate_by_chessboard(const ChessboardOptions& options);

}  // namespace azimuth
