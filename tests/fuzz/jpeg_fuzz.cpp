// Any bytes as a JPEG image.

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/camera/jpeg.hpp"
#include "drivers/wire/image_header.hpp"
#include "tests/fuzz/image_decoding.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static azimuth::JpegDecoder decoder;
  const auto file = std::as_bytes(std::span(data, size));
  azimuth::jpeg_size(file);
  azimuth::fuzz::decode(decoder, file);
  return 0;
}
