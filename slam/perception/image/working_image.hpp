#pragma once
#include <cstdint>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/perception/image/plane.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The square image that front ends process: the disc of `radius_px` about the optical axis, centred in the square,
/// with square pixels. Small images are never enlarged.
struct WorkingSquare {
  ImageAxes axes;          ///< Axes of the camera's image
  double radius_px = 0.0;  ///< Radius of the disc in the camera's image
  int side_px = 0;         ///< Side of the square
  double scale = 1.0;      ///< Pixels of the square per pixel of the camera's image, at most 1

  double middle_px() const { return 0.5 * (side_px - 1); }
  /// Maps a point of the square to the camera's image.
  Pixel camera_pixel(double x_px, double y_px) const {
    const double u = axes.centre_px.x() + (x_px - middle_px()) / scale;
    return {u, axes.beta * (axes.centre_px.y() + (y_px - middle_px()) / scale)};
  }
};

/// Makes a square with sides of at most `most_px` (0: unlimited) for a disc of `radius_px` > 0.
WorkingSquare working_square(const ImageAxes& axes, double radius_px, int most_px);

/// Makes the working square from camera images of one size. Each grey pixel is the mean of the pixels that it covers,
/// with weights that fall off linearly, which avoids aliasing of detail finer than the square can show. Beyond the
/// camera's image, its edge pixels are repeated.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class WorkingImage {
 public:
  WorkingImage(const WorkingSquare& square, int width_px, int height_px);

  /// `image` must be readable() and have the size given to the constructor. Output values are in 1/256 of a grey level.
  void make(const ImageView& image, Plane<std::uint16_t>& out);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  /// The input pixels along one axis that contribute to one output pixel: `count` pixels from `first` on.
  struct Taps {
    int first = 0;
    int count = 0;
    std::size_t weights = 0;  ///< Index of the first weight
  };
  struct Axis {
    /// One entry for each output pixel, in ascending order of the first input pixel
    std::vector<Taps> taps;
    std::vector<std::uint16_t> weights;  ///< The weights of one output pixel add up to 256
  };
  static Axis axis(double first_px, double step_px, int outputs, int inputs);

  const std::uint8_t* gray(const ImageView& image, int row);
  void squeeze(const std::uint16_t* sums, std::uint16_t* out) const;

  int width_px_, height_px_;
  Axis columns_, rows_;
  int first_column_, last_column_;  ///< The columns [first, last) of the camera's image that are needed
  /// Ring of converted grey rows, indexed by row modulo the ring's size
  std::vector<std::vector<std::uint8_t>> kept_;
  std::vector<int> kept_row_;
  std::vector<std::uint16_t> sums_;
};

}  // namespace azimuth
