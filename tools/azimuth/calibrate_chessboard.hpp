#pragma once
// azimuth calibrate fisheye --chessboard: calibrates the lens from images of a chessboard.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/sample/image.hpp"
#include "tools/azimuth/recorded_drive.hpp"
#include "tools/lens_fit/lens.hpp"

namespace azimuth {

struct ChessboardOptions {
  std::vector<std::filesystem::path> images;  ///< image files, folders of images, or run folders
  std::filesystem::path rig;                  ///< empty: the rig of a run folder, if any
  std::string board;                          ///< COLUMNSxROWS
  std::optional<double> square_m, field_of_view_rad;
  std::size_t most_images = 60;
  CalibrationOutputs outputs;
};

/// Reads the rig from the file and refuses a rig that is not for a fisheye with images of this size. Without a file it
/// returns a fisheye rig of which only the image size is known.
Rig rig_of_fisheye_or_refuse(const std::filesystem::path& file, const FrameFormat& format);

void calibrate_by_chessboard(const ChessboardOptions& options);

/// Prints centre, coefficients, and radii up to `seen_to_rad`. Without `scale_known`, a0 still has its initial value.
void print_lens(const Lens& lens, const LensCovariance& covariance, double seen_to_rad, bool scale_known);

}  // namespace azimuth
