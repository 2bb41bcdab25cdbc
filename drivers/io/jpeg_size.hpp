#pragma once
#include <optional>
#include <utility>

#include "drivers/io/event_codec.hpp"

namespace azimuth {

/// Width and height [px] that a JPEG file claims, without a decoder: what viewers of logs need to know. Nothing when
/// there is no such header. Any bytes are safe. Internal to drivers/io.
std::optional<std::pair<int, int>> jpeg_size(Bytes file);

}  // namespace azimuth
