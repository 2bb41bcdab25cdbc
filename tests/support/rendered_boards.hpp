#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "tools/board_fit/board_fit.hpp"

namespace azimuth::test {

/// That tests are made with.
inline constexpr Chessboard kChessboard{.columns = 9, .rows = 6, .square_m = 0.03};

/// A grey image that owns its pixels.
struct GreyImage {
  FrameFormat format;
  std::vector<std::byte> bytes;
  ImageView view() const { return {format, bytes}; }
};

/// Whether a whole chessboard with its white edge is in the image of a camera.
bool is_in_image(const CameraModel& camera, int side_px, const Chessboard& board,
                 const Eigen::Isometry3d& T_camera_board);

/// As a camera sees it: 4 by 4 samples a pixel, light that falls off to one side, noise of `sigma_grey` levels.
GreyImage rendered(const CameraModel& camera, int side_px, const Chessboard& board,
                   const Eigen::Isometry3d& T_camera_board, double sigma_grey, std::mt19937_64& random);

/// Somewhere within `farthest_rad` from the axis, tilted and rolled by chance, so near that its squares are some pixels
/// wide, and wholly in the image.
Eigen::Isometry3d board_somewhere(const CameraModel& camera, int side_px, const Chessboard& board, double farthest_rad,
                                  std::mt19937_64& random);

/// Wide by 185 degrees in an image of kSide_px by kSide_px, its centre off the image's middle.
inline constexpr int kSide_px = 768;
Lens lens_185();
CameraModel camera_185();

/// As find_chessboard() would have them, without an image: where the corners are, and noise.
std::vector<Pixel> corners_of(const CameraModel& camera, const Chessboard& board,
                              const Eigen::Isometry3d& T_camera_board, double sigma_px, std::mt19937_64& random);

}  // namespace azimuth::test
