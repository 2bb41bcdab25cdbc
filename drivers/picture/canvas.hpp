#pragma once
// Internal to drivers/picture.

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/camera/image_axes.hpp"

namespace azimuth {

/// Red, green, blue.
using PictureColour = std::array<int, 3>;

/// A picture with a margin around the image, for labels at the mirror's rim. Drawing functions use image coordinates;
/// parts outside the picture are clipped.
///
/// Thread contract: thread-bound. Storage is kept from picture to picture.
class Canvas {
 public:
  static constexpr int kMargin_px = 48;

  /// Clears the canvas to black, for an image of the given size.
  void begin(int width_px, int height_px);
  /// The area of the image in the picture.
  cv::Mat image() const;
  const cv::Mat& picture() const { return picture_; }

  void line(const Pixel& from, const Pixel& to, const PictureColour& colour, int thickness_px = 1);
  void polyline(const std::vector<Pixel>& points, bool closed, const PictureColour& colour, int thickness_px = 1);
  void circle(const Pixel& centre, double radius_px, const PictureColour& colour);
  static Pixel label_size_px(const std::string& text);
  /// Writes a text centred at `middle`.
  void label(const Pixel& middle, const std::string& text, const PictureColour& colour);
  /// Writes a line of text at the upper left of the picture; `line` counts from 0.
  void caption(int line, const std::string& text, const PictureColour& colour);

 private:
  cv::Mat picture_;
};

}  // namespace azimuth
