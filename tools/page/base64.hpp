#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace azimuth {

/// Base64 encoding of RFC 4648 with padding. Reentrant.
std::string base64(std::span<const std::byte> bytes);

}  // namespace azimuth
