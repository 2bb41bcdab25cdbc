#pragma once
#include <chrono>
#include <cstdint>

namespace azimuth {

/// When something was heard.
struct Heard {
  std::chrono::steady_clock::time_point at{};
  std::int64_t wall_us = 0;  ///< since the Unix epoch
};

}  // namespace azimuth
