#pragma once
// Internal to picture.

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/camera/image_axes.hpp"

namespace azimuth {

/// Red, green, blue.
using PictureColour = std::array<int, 3>;

/// A picture that is larger than the image by a margin, so that there is room for what stands at the mirror's rim.
/// Drawn on in the image's own coordinates; what lies outside is left out.
///
/// Thread contract: thread-bound. Storage is kept from picture to picture.
class Canvas {
 public:
  static constexpr int kMargin_px = 48;

  /// Black, for an image of that size.
  void begin(int width_px, int height_px);
  /// The part the image goes to.
  cv::Mat image() const;
  const cv::Mat& picture() const { return picture_; }

  void line(const Pixel& from, const Pixel& to, const PictureColour& colour, int thickness_px = 1);
  void polyline(const std::vector<Pixel>& points, bool closed, const PictureColour& colour, int thickness_px = 1);
  void circle(const Pixel& centre, double radius_px, const PictureColour& colour);
  static Pixel label_size_px(const std::string& text);
  /// With its middle there.
  void label(const Pixel& middle, const std::string& text, const PictureColour& colour);
  /// A line of writing at the picture's upper left, counted from 0.
  void caption(int line, const std::string& text, const PictureColour& colour);

 private:
  cv::Mat picture_;
};

}  // namespace azimuth
