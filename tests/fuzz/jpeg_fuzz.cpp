// JPEG images from anywhere: what is refused is refused quietly, what is accepted has the size its header claims.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/camera/jpeg.hpp"
#include "drivers/io/jpeg_size.hpp"

namespace {

using namespace azimuth;

constexpr int kMaxPixels = 1 << 16;  // the library's work on large images is no news

void decode(JpegDecoder& decoder, std::span<const std::byte> file, const JpegHeader& header, PixelFormat pixels) {
  const ImageView image = decoder.decode(file, pixels);
  if (image.bytes.empty()) {
    if (decoder.problem().empty()) std::abort();
    return;
  }
  if (!image.readable() || image.format != packed_format(pixels, header.width_px, header.height_px)) std::abort();
  unsigned sum = 0;
  for (const std::byte byte : image.bytes) sum += std::to_integer<unsigned>(byte);
  [[maybe_unused]] static volatile unsigned sink;
  sink = sum;  // reads every pixel under the sanitizers' eyes
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static JpegDecoder decoder;
  const std::span<const std::byte> file = std::as_bytes(std::span(data, size));
  jpeg_size(file);
  const std::optional<JpegHeader> header = decoder.read_header(file);
  if (!header || header->width_px > kMaxPixels / header->height_px) return 0;
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8}) decode(decoder, file, *header, pixels);
  return 0;
}
