#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "tools/board_fit/board_fit.hpp"

namespace azimuth::test {

/// The chessboard that the tests use.
inline constexpr Chessboard kChessboard{.columns = 9, .rows = 6, .square_m = 0.03};

/// A grey image that owns its pixels.
struct GreyImage {
  FrameFormat format;
  std::vector<std::byte> bytes;
  ImageView view() const { return {format, bytes}; }
};

/// Whether the whole chessboard, including its white border, is in the camera's image.
bool is_in_image(const CameraModel& camera, int side_px, const Chessboard& board,
                 const Eigen::Isometry3d& T_camera_board);

/// The image of a board: 4 by 4 samples per pixel, light that falls off to one side, noise of `sigma_grey` levels.
GreyImage rendered(const CameraModel& camera, int side_px, const Chessboard& board,
                   const Eigen::Isometry3d& T_camera_board, double sigma_grey, std::mt19937_64& random);

/// A random pose of a board within `farthest_rad` of the optical axis, tilted and rolled. The board is wholly in the
/// image and near enough that its squares are several pixels wide.
Eigen::Isometry3d board_somewhere(const CameraModel& camera, int side_px, const Chessboard& board, double farthest_rad,
                                  std::mt19937_64& random);

/// A field of view of 185 degrees in an image of kSide_px by kSide_px; the optical centre is off the image's middle.
inline constexpr int kSide_px = 768;
Lens lens_185();
CameraModel camera_185();

/// The corners that find_chessboard() would return, computed without an image: projected corners with noise.
std::vector<Pixel> corners_of(const CameraModel& camera, const Chessboard& board,
                              const Eigen::Isometry3d& T_camera_board, double sigma_px, std::mt19937_64& random);

}  // namespace azimuth::test
