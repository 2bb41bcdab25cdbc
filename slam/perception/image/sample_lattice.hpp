#pragma once
#include <cstddef>
#include <vector>

#include "slam/camera/image_mask.hpp"

namespace azimuth {

/// Evenly spread samples of the visible part of an image, each a few adjacent pixels in one row. They suffice to judge
/// an image as a whole.
///
/// Thread contract: reentrant.
class SampleLattice {
 public:
  static constexpr int kSampleWidth_px = 4;   ///< Averaging halves the standard deviation of the sensor's noise
  static constexpr int kMostSamples = 16384;  ///< Approximate

  struct Sample {
    int u = 0;              ///< The sample's first pixel
    std::size_t left = 0;   ///< Index of the sample to the left; its own index if there is none.
    std::size_t above = 0;  ///< Index of the sample above; its own index if there is none.
  };
  struct Row {
    int v = 0;
    int first_u = 0, end_u = 0;      ///< The pixel columns that hold all samples of the row
    std::size_t begin = 0, end = 0;  ///< Indices of the row's samples
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
