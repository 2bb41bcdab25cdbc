#pragma once
// What images of one camera show in the same place again and again: edges and detail.

#include <opencv2/core.hpp>

namespace azimuth {

/// Edges of a reduced image, a mean over images. An edge of direction t counts as m exp(2 i t) with 0 <= m < 1 growing
/// with its steepness: light to dark and dark to light are alike, edges that come and go in all directions cancel, and
/// one that stays adds up.
struct EdgeMap {
  double scale = 1.0;  ///< pixels of the map for one of the image
  cv::Mat normals;     ///< CV_32FC2: m cos 2t, m sin 2t with t the direction of the edge's normal
  cv::Mat detail;      ///< CV_32FC1: m of all pixels, on edges or not

  // Whole numbers are the centres of pixels in both.
  double to_map(double image_px) const { return (image_px + 0.5) * scale - 0.5; }
  double to_image(double map_px) const { return (map_px + 0.5) / scale - 0.5; }
};

/// Thread contract: thread-bound.
class EdgeMapBuilder {
 public:
  explicit EdgeMapBuilder(double scale) : scale_(scale) {}

  /// CV_8UC1, all of one size.
  void add(const cv::Mat& gray);
  /// Of what was added; at least one image.
  EdgeMap build() const;

 private:
  double scale_;
  int images_ = 0;
  cv::Mat normals_, detail_;  // sums
};

}  // namespace azimuth
