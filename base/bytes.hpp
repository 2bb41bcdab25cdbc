#pragma once
#include <cstddef>
#include <span>

namespace azimuth {

using Bytes = std::span<const std::byte>;

}  // namespace azimuth
