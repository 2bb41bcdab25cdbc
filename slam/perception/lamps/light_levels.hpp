#pragma once
#include <array>
#include <cstdint>

#include "slam/perception/lamps/gray_view.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/lamps/visible_rows.hpp"

namespace azimuth {

/// Brightness levels of an image, in 8-bit steps.
struct Light {
  double background = 0.0;  ///< Median of the image
  double noise = 1.0;       ///< Standard deviation of the background, at least 1
  double lamps = 0.0;       ///< The level that LampSettings::light_share of the pixels reach
  int threshold = 255;      ///< Pixels of at least this level are bright; 1 to 255.
};

/// Follows the exposure: judges each image by a few thousand of its pixels. The threshold moves only if it is off by
/// more than a part of the contrast, so that the outlines of lamps do not change with the threshold from image to
/// image.
///
/// Thread contract: thread-bound. Nothing allocates.
class LightLevels {
 public:
  explicit LightLevels(const LampSettings& settings) : settings_(settings) {}

  /// Returns the levels of the next image. A visible part too small to hold a sample counts as dark.
  Light judge(const GrayView& image, const VisibleRows& visible);

 private:
  using Histogram = std::array<std::uint32_t, 256>;
  Histogram sample(const GrayView& image, const VisibleRows& visible) const;
  int follow(double wanted, double leeway);

  LampSettings settings_;
  int threshold_ = 0;  // Of the last image; 0 before the first image.
};

}  // namespace azimuth
