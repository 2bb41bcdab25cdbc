#pragma once
#include <cstdint>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/perception/image/plane.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The square that front ends work on: the disc of `radius_px` about the optical axis, its centre in the middle, pixels
/// as wide as high. Small images are never enlarged.
struct WorkingSquare {
  ImageAxes axes;          ///< of the camera's image
  double radius_px = 0.0;  ///< of the disc in the camera's image
  int side_px = 0;         ///< of the square; 0: as many as the disc has
  double scale = 1.0;      ///< pixels of the square for one of the camera's, at most 1

  double middle_px() const { return 0.5 * (side_px - 1); }
  /// A point of the square in the camera's image.
  Pixel camera_pixel(double x_px, double y_px) const {
    const double u = axes.centre_px.x() + (x_px - middle_px()) / scale;
    return {u, axes.beta * (axes.centre_px.y() + (y_px - middle_px()) / scale)};
  }
};

/// A square with sides of at most `most_px` (0: any) for a disc of `radius_px` > 0.
WorkingSquare working_square(const ImageAxes& axes, double radius_px, int most_px);

/// Makes the square from camera images of one size: grey, each pixel the mean of those it covers, with weights that
/// fall off linearly, so that what is finer than the square can show does not alias. Beyond the camera's image its edge
/// goes on.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class WorkingImage {
 public:
  WorkingImage(const WorkingSquare& square, int width_px, int height_px);

  /// `image` must be readable() and of the size given to the constructor. Values are in 1/256 of a grey level.
  void make(const ImageView& image, Plane<std::uint16_t>& out);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  /// What pixels along one axis of the camera's image an output pixel is made of: weights from `first` on.
  struct Taps {
    int first = 0;
    int count = 0;
    std::size_t weights = 0;  ///< index of the first
  };
  struct Axis {
    std::vector<Taps> taps;              ///< one for each output pixel, first pixels ascending
    std::vector<std::uint16_t> weights;  ///< those of one output pixel add up to 256
  };
  static Axis axis(double first_px, double step_px, int outputs, int inputs);

  const std::uint8_t* gray(const ImageView& image, int row);
  void squeeze(const std::uint16_t* sums, std::uint16_t* out) const;

  int width_px_, height_px_;
  Axis columns_, rows_;
  int first_column_, last_column_;               ///< of the camera's image that are needed
  std::vector<std::vector<std::uint8_t>> kept_;  ///< grey rows by row modulo their number
  std::vector<int> kept_row_;
  std::vector<std::uint16_t> sums_;
};

}  // namespace azimuth
