#pragma once
#include <cstddef>
#include <functional>

namespace azimuth {

/// Callback of long work, with the part done and the total in any unit. May be empty.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace azimuth
