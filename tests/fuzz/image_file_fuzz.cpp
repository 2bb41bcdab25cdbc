// Any bytes as an image file. The result must be a completely readable image or a reason.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "tools/calibrate/image_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto image = azimuth::decode_image(std::as_bytes(std::span(data, size)), "image");
  if (image ? !image->view().readable() : image.error().front().message.empty()) std::abort();
  return 0;
}
