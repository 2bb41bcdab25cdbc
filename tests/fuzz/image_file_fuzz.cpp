// Any bytes as an image file: an image that can be read as a whole, or a reason, never a crash.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "tools/calibrate/read_image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto image = azimuth::decode_image(std::as_bytes(std::span(data, size)), "image");
  if (image ? !image->view().readable() : image.error().front().message.empty()) std::abort();
  return 0;
}
