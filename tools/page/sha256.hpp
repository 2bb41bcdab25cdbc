#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace azimuth {

/// SHA-256 (FIPS 180-4), by which a Content-Security-Policy identifies a script. Reentrant.
std::array<std::byte, 32> sha256(std::string_view text);

}  // namespace azimuth
