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
  double noise = 0.0;  ///< Standard deviation of the noise of each sample, in 8-bit steps
  /// Part of the brightness lost at `vignetting_radius_px`. The loss grows with the square of the radius.
  double vignetting = 0.0;
  double vignetting_radius_px = 1.0;
  std::uint64_t seed = 1;  ///< Seed of the noise
};

/// Converts light to the bytes of a frame: vignetting, noise, pixel format.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class ImageSensor {
 public:
  ImageSensor(const ImageSensorSettings& settings, const ImageAxes& axes, int width_px, int height_px);

  /// True for gray8, rgb8, bgr8, yuyv and uyvy.
  static bool can_write(PixelFormat pixels);

  /// Begins the next exposure; each has its own noise.
  void begin_exposure() { ++exposures_; }
  /// Writes rows [first, last). `format` must have the size of the sensor and a writable pixel format; `bytes` must be
  /// large enough for the whole frame.
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
  std::vector<std::uint16_t> gain_;  // Gain of each pixel; 256 means no loss
  std::vector<std::int8_t> noise_;   // kNoiseSamples samples, and those of one more row
  std::vector<PackedColour> row_;
};

}  // namespace azimuth
