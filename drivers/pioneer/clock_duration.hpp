#pragma once
// Internal to drivers/pioneer.

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

inline Clock::duration clock_duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace azimuth::pioneer
