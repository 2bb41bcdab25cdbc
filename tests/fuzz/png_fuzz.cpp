// PNG images from anywhere: what is refused is refused quietly, what is accepted has the size its header claims.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/camera/png.hpp"

namespace {

using namespace azimuth;

constexpr int kMaxPixels = 1 << 16;  // the library's work on large images is no news

void decode(PngDecoder& decoder, std::span<const std::byte> file, const PngHeader& header, PixelFormat pixels) {
  const ImageView image = decoder.decode(file, pixels);
  if (image.bytes.empty() == decoder.problem().empty()) std::abort();
  if (image.bytes.empty()) return;
  if (!image.readable() || image.format != packed_format(pixels, header.width_px, header.height_px)) std::abort();
  unsigned sum = 0;
  for (const std::byte byte : image.bytes) sum += std::to_integer<unsigned>(byte);
  [[maybe_unused]] static volatile unsigned sink;
  sink = sum;  // reads every pixel under the sanitizers' eyes
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static PngDecoder decoder;
  const std::span<const std::byte> file = std::as_bytes(std::span(data, size));
  const std::optional<PngHeader> header = decoder.read_header(file);
  if (!header || header->width_px > kMaxPixels / header->height_px) return 0;
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8}) decode(decoder, file, *header, pixels);
  return 0;
}
