#pragma once
// Worlds for drives that last hours.

#include <cstdint>

#include "sim/world/scenario.hpp"

namespace azimuth {

struct LargeHall {
  int landmarks = 2000;
  double side_m = 95.0;
  double lane_m = 10.0;  ///< distance between neighbouring lanes of the path
};

/// A hall of named landmarks, with about twenty in view, driven through in lanes at 0.5 m/s.
Scenario large_hall(std::uint64_t seed, double minutes, const LargeHall& hall = {});

/// The lab, with as many laps as the time allows.
Scenario long_lab(std::uint64_t seed, double minutes);

}  // namespace azimuth
