#pragma once
// What the bytes of a compressed image claim to be, without a decoder. Any bytes are safe.
//
// Thread contract: reentrant.

#include <optional>
#include <utility>

#include "base/bytes.hpp"

namespace azimuth {

/// Width and height [px] that a JPEG file claims: what viewers of logs need to know. Nothing when there is no such
/// header.
std::optional<std::pair<int, int>> jpeg_size(Bytes file);

/// Whether a file claims to be a PNG image: its first 8 bytes.
bool is_png(Bytes file);

}  // namespace azimuth
