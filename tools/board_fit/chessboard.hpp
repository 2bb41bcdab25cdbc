#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Inner corners of a chessboard, where four squares meet: one less each way than there are squares.
struct Chessboard {
  int columns = 0, rows = 0;
  double square_m = 1.0;  ///< side of a square

  std::size_t corners() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  /// Row by row, in the board's own frame, in which its middle is the origin and z = 0 [m].
  Eigen::Vector3d corner(std::size_t index) const {
    const int column = static_cast<int>(index) % columns, row = static_cast<int>(index) / columns;
    return square_m * Eigen::Vector3d(column - 0.5 * (columns - 1), row - 0.5 * (rows - 1), 0.0);
  }
  friend bool operator==(const Chessboard&, const Chessboard&) = default;
};

/// All its corners, row by row, in an image of gray8; nothing: it is not there, or not whole. From which of its ends a
/// board is counted may differ from image to image.
std::optional<std::vector<Pixel>> find_chessboard(const ImageView& image, const Chessboard& board);

/// How many inner corners the board in the image has, whatever their number is; nothing: none is recognised.
std::optional<Chessboard> any_chessboard(const ImageView& image);

}  // namespace azimuth
