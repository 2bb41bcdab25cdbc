#pragma once
#include <cstddef>
#include <functional>

namespace azimuth {

/// Told now and then by work that may take long: how much of it is done, in whatever it counts. Empty: nobody listens.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace azimuth
