#pragma once
// The edges and the detail that many images of one camera have in common.

#include <opencv2/core.hpp>

namespace azimuth {

/// The edges of a reduced image, averaged over images. An edge with normal direction t contributes m exp(2 i t), where
/// m in [0, 1) grows with its steepness. The doubled angle makes light-to-dark and dark-to-light edges equal. Edges
/// that change direction from image to image cancel; an edge that stays adds up.
struct EdgeMap {
  double scale = 1.0;  ///< Pixels of the map per pixel of the image
  cv::Mat normals;     ///< CV_32FC2: m cos 2t and m sin 2t, where t is the direction of the edge's normal.
  cv::Mat detail;      ///< CV_32FC1: m of all pixels, including pixels that are not on edges.

  // Integer coordinates denote pixel centres, in the map and in the image.
  double to_map(double image_px) const { return (image_px + 0.5) * scale - 0.5; }
  double to_image(double map_px) const { return (map_px + 0.5) / scale - 0.5; }
};

/// Accumulates images into an EdgeMap. Thread contract: thread-bound.
class EdgeMapBuilder {
 public:
  explicit EdgeMapBuilder(double scale) : scale_(scale) {}

  /// `gray` is CV_8UC1. All images must have the same size.
  void add(const cv::Mat& gray);
  /// Returns the mean over all added images. At least one image must have been added.
  EdgeMap build() const;

 private:
  double scale_;
  int images_ = 0;
  cv::Mat normals_, detail_;  // Sums over the images
};

}  // namespace azimuth
