#pragma once
#include <array>
#include <cstdint>

#include "slam/perception/lamps/gray_view.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/lamps/visible_rows.hpp"

namespace azimuth {

/// How bright things are in an image, in 8-bit steps.
struct Light {
  double background = 0.0;  ///< its median
  double noise = 1.0;       ///< its standard deviation, at least 1
  double lamps = 0.0;       ///< what LampSettings::light_share of the pixels reach
  int threshold = 255;      ///< from here on a pixel shines, 1 to 255
};

/// Follows the exposure: judges each image by a few thousand of its pixels. The threshold only moves when it is off by
/// more than a part of the contrast, so that the outlines of lamps do not move with it from image to image.
///
/// Thread contract: thread-bound. Nothing allocates.
class LightLevels {
 public:
  explicit LightLevels(const LampSettings& settings) : settings_(settings) {}

  /// Of the next image. A visible part too small to hold a sample is dark.
  Light judge(const GrayView& image, const VisibleRows& visible);

 private:
  using Histogram = std::array<std::uint32_t, 256>;
  Histogram sample(const GrayView& image, const VisibleRows& visible) const;
  int follow(double wanted, double leeway);

  LampSettings settings_;
  int threshold_ = 0;  // of the last image; 0: there was none
};

}  // namespace azimuth
