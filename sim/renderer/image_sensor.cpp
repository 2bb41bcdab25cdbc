#include "sim/renderer/image_sensor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/world/random.hpp"

namespace azimuth {

namespace {

std::uint64_t scrambled(std::uint64_t value) {  // Hash that spreads neighbouring numbers over 64 bits
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

std::byte sample(unsigned value, int noise) {
  return static_cast<std::byte>(std::clamp(static_cast<int>(value) + noise, 0, 255));
}

void write_gray(std::span<const PackedColour> row, const std::int8_t* noise, std::byte* out) {
  for (std::size_t u = 0; u < row.size(); ++u) out[u] = sample(luma(row[u]), noise[u]);
}

void write_three(std::span<const PackedColour> row, const std::int8_t* noise, std::byte* out, unsigned first_shift) {
  const unsigned last_shift = 16 - first_shift;
  for (std::size_t u = 0; u < row.size(); ++u) {
    out[3 * u] = sample(row[u] >> first_shift & 0xFFU, noise[3 * u]);
    out[3 * u + 1] = sample(green_of(row[u]), noise[3 * u + 1]);
    out[3 * u + 2] = sample(row[u] >> last_shift & 0xFFU, noise[3 * u + 2]);
  }
}

/// BT.601 with the full range of 256 steps, as JPEG cameras use it.
void write_422(std::span<const PackedColour> row, const std::int8_t* noise, std::byte* out, std::size_t luma_at) {
  const std::size_t chroma_at = 1 - luma_at;
  for (std::size_t u = 0; u + 1 < row.size(); u += 2) {
    const PackedColour both = mix(row[u], row[u + 1], 128);
    const auto red = static_cast<int>(red_of(both)), green = static_cast<int>(green_of(both));
    const auto blue = static_cast<int>(blue_of(both));
    std::byte* const pair = out + 2 * u;
    pair[luma_at] = sample(luma(row[u]), noise[2 * u]);
    pair[luma_at + 2] = sample(luma(row[u + 1]), noise[2 * u + 1]);
    pair[chroma_at] = sample(128, (-43 * red - 85 * green + 128 * blue) / 256 + noise[2 * u + 2]);
    pair[chroma_at + 2] = sample(128, (128 * red - 107 * green - 21 * blue) / 256 + noise[2 * u + 3]);
  }
}

}  // namespace

ImageSensor::ImageSensor(const ImageSensorSettings& settings, const ImageAxes& axes, int width_px, int height_px)
    : width_px_(static_cast<std::size_t>(width_px)),
      seed_(settings.seed),
      vignetting_(settings.vignetting > 0.0),
      row_(width_px_) {
  Random random(settings.seed, RandomPurpose::scene);
  noise_.resize(kNoiseSamples + 3 * width_px_);
  for (std::int8_t& each : noise_) {
    each = static_cast<std::int8_t>(std::lround(std::clamp(random.normal(settings.noise), -127.0, 127.0)));
  }
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double part = axes.polar({u, v}).radius_px / settings.vignetting_radius_px;
      gain_.push_back(
          static_cast<std::uint16_t>(fraction256(static_cast<float>(1.0 - settings.vignetting * part * part))));
    }
  }
}

bool ImageSensor::can_write(PixelFormat pixels) {
  return pixels == PixelFormat::gray8 || pixels == PixelFormat::rgb8 || pixels == PixelFormat::bgr8 ||
         pixels == PixelFormat::yuyv || pixels == PixelFormat::uyvy;
}

const std::int8_t* ImageSensor::noise_for_row(int row) const {
  const std::uint64_t number = scrambled(seed_ + scrambled((exposures_ << 16U) + static_cast<std::uint64_t>(row)));
  return noise_.data() + number % kNoiseSamples;
}

void ImageSensor::darken(std::span<const PackedColour> row, int v) {
  const std::uint16_t* const gain = gain_.data() + static_cast<std::size_t>(v) * width_px_;
  for (std::size_t u = 0; u < width_px_; ++u) row_[u] = dim(row[u], gain[u]);
}

void ImageSensor::read_rows(int first, int last, std::span<const PackedColour> image, const FrameFormat& format,
                            std::span<std::byte> bytes) {
  assert(can_write(format.pixels) && bytes.size() >= format.bytes() && image.size() == gain_.size());
  for (int v = first; v < last; ++v) {
    std::span<const PackedColour> row = image.subspan(static_cast<std::size_t>(v) * width_px_, width_px_);
    if (vignetting_) {
      darken(row, v);
      row = row_;
    }
    std::byte* const out = bytes.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(format.stride_bytes);
    const std::int8_t* const noise = noise_for_row(v);
    switch (format.pixels) {
      case PixelFormat::rgb8:
        write_three(row, noise, out, 0);
        break;
      case PixelFormat::bgr8:
        write_three(row, noise, out, 16);
        break;
      case PixelFormat::yuyv:
        write_422(row, noise, out, 0);
        break;
      case PixelFormat::uyvy:
        write_422(row, noise, out, 1);
        break;
      default:
        write_gray(row, noise, out);
    }
  }
}

}  // namespace azimuth
