#pragma once
#include <chrono>
#include <cstdint>

namespace azimuth {

/// Time of reception of a message.
struct Reception {
  std::chrono::steady_clock::time_point at{};
  std::int64_t wall_us = 0;  ///< since the Unix epoch
};

}  // namespace azimuth
