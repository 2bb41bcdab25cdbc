#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace azimuth {

/// SHA-256 (FIPS 180-4): what a Content-Security-Policy names a script by. Reentrant.
std::array<std::byte, 32> sha256(std::string_view text);

}  // namespace azimuth
