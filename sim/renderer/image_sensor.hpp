#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "sim/renderer/colour.hpp"
#include "slam/camera/image_axes.hpp"

namespace azimuth {

struct ImageSensorSettings {
  double noise = 0.0;       ///< standard deviation of each sample, in its 8-bit steps
  double vignetting = 0.0;  ///< part of the brightness lost at `vignetting_radius_px`, growing with the radius squared
  double vignetting_radius_px = 1.0;
  std::uint64_t seed = 1;  ///< of the noise
};

/// Turns light into the bytes of a frame: vignetting, noise, pixel format.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class ImageSensor {
 public:
  ImageSensor(const ImageSensorSettings& settings, const ImageAxes& axes, int width_px, int height_px);

  /// gray8, rgb8, bgr8, yuyv and uyvy.
  static bool can_write(PixelFormat pixels);

  /// Each exposure has noise of its own.
  void begin_exposure() { ++exposures_; }
  /// Writes rows from `first` up to but not including `last`. `format` must be of the sensor's size with a format that
  /// it can write, `bytes` large enough for the whole frame.
  void read_rows(int first, int last, std::span<const PackedColour> image, const FrameFormat& format,
                 std::span<std::byte> bytes);

 private:
  static constexpr std::size_t kNoiseSamples = std::size_t{1} << 16U;

  const std::int8_t* noise_for_row(int row) const;
  void darken(std::span<const PackedColour> row, int v);

  std::size_t width_px_;
  std::uint64_t seed_;
  std::uint64_t exposures_ = 0;
  bool vignetting_;
  std::vector<std::uint16_t> gain_;  // of each pixel, 256: all light
  std::vector<std::int8_t> noise_;   // longer than kNoiseSamples by the samples of one row
  std::vector<PackedColour> row_;
};

}  // namespace azimuth
