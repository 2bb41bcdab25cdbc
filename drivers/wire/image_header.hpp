#pragma once
// The properties in the header of a compressed image, without a decoder. Any bytes are safe.
//
// Thread contract: reentrant.

#include <optional>
#include <utility>

#include "base/bytes.hpp"

namespace azimuth {

/// Width and height [px] in the header of a JPEG file, for viewers of logs. None without such a header.
std::optional<std::pair<int, int>> jpeg_size(Bytes file);

/// True: the file starts with the 8 bytes of a PNG image.
bool is_png(Bytes file);

}  // namespace azimuth
