#pragma once
#include <cstddef>
#include <vector>

#include "slam/camera/image_mask.hpp"

namespace azimuth {

/// Evenly spread samples of the visible part of an image, each a few pixels side by side in one row: what is enough to
/// judge an image as a whole.
///
/// Thread contract: reentrant.
class SampleLattice {
 public:
  static constexpr int kSampleWidth_px = 4;   ///< averages the sensor's noise to half
  static constexpr int kMostSamples = 16384;  ///< about

  struct Sample {
    int u = 0;              ///< its first pixel
    std::size_t left = 0;   ///< index of the sample beside it; its own index: there is none
    std::size_t above = 0;  ///< likewise
  };
  struct Row {
    int v = 0;
    int first_u = 0, end_u = 0;      ///< the pixels that hold all samples of the row
    std::size_t begin = 0, end = 0;  ///< its samples
  };

  SampleLattice() = default;
  SampleLattice(const ImageMask& mask, int width_px, int height_px);

  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  std::vector<Row> rows_;
  std::vector<Sample> samples_;
};

}  // namespace azimuth
