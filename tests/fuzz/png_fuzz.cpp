// Any bytes as a PNG image.

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/camera/png.hpp"
#include "tests/fuzz/image_decoding.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static azimuth::PngDecoder decoder;
  azimuth::fuzz::decode(decoder, std::as_bytes(std::span(data, size)));
  return 0;
}
