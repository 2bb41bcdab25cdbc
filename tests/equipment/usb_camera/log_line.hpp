#pragma once
#include <chrono>
#include <cstdio>
#include <string_view>

namespace azimuth::sim {

/// Prints to standard error with the time on CLOCK_MONOTONIC, for comparison with the kernel's log.
inline void log_line(std::string_view text) {
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  std::fprintf(stderr, "[%12.6f] %.*s\n", now.count(), static_cast<int>(text.size()), text.data());
}

}  // namespace azimuth::sim
