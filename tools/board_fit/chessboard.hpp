#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The inner corners of a chessboard, where four squares meet. Each direction has one corner fewer than squares.
struct Chessboard {
  int columns = 0, rows = 0;
  double square_m = 1.0;  ///< side of a square

  std::size_t corners() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  /// Corner position [m] in the board's frame: origin at the board's middle, z = 0. Corners are counted row by row.
  Eigen::Vector3d corner(std::size_t index) const {
    const int column = static_cast<int>(index) % columns, row = static_cast<int>(index) / columns;
    return square_m * Eigen::Vector3d(column - 0.5 * (columns - 1), row - 0.5 * (rows - 1), 0.0);
  }
  friend bool operator==(const Chessboard&, const Chessboard&) = default;
};

/// All corners of the board in a gray8 image, row by row. Nothing if the board is not completely visible. The corner
/// from which the board is counted may differ between images.
std::optional<std::vector<Pixel>> find_chessboard(const ImageView& image, const Chessboard& board);

/// The size of any chessboard that the image shows; nothing if none is recognised.
std::optional<Chessboard> any_chessboard(const ImageView& image);

}  // namespace azimuth
