#pragma once
// Requirements on every decoder of image files, for any bytes.

#include <cstddef>
#include <cstdlib>
#include <span>

#include "slam/sample/image.hpp"

namespace azimuth::fuzz {

inline constexpr int kMaxPixels = 1 << 16;  // larger images only take time

/// Decodes to grey and to colour. A refused file needs a reason; an accepted one must have the size in its header.
template <class Decoder>
void decode(Decoder& decoder, std::span<const std::byte> file);

}  // namespace azimuth::fuzz

template <class Decoder>
void azimuth::fuzz::decode(Decoder& decoder, std::span<const std::byte> file) {
  const auto header = decoder.read_header(file);
  if (!header || header->width_px > kMaxPixels / header->height_px) return;
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8}) {
    const ImageView image = decoder.decode(file, pixels);
    if (image.bytes.empty() == decoder.problem().empty()) std::abort();
    if (image.bytes.empty()) continue;
    if (!image.readable() || image.format != packed_format(pixels, header->width_px, header->height_px)) std::abort();
    unsigned sum = 0;
    for (const std::byte byte : image.bytes) sum += std::to_integer<unsigned>(byte);
    [[maybe_unused]] static volatile unsigned sink;
    sink = sum;  // lets the sanitizers check every pixel
  }
}
