#pragma once
// Worlds to be driven in for hours.

#include <cstdint>

#include "sim/world/scenario.hpp"

namespace azimuth {

struct LargeHall {
  int landmarks = 2000;
  double side_m = 95.0;
  double lane_m = 10.0;  ///< between the lanes that it is driven through in
};

/// A hall of named landmarks, of which some twenty are in view, driven through in lanes at 0.5 m/s.
Scenario large_hall(std::uint64_t seed, double minutes, const LargeHall& hall = {});

/// The lab, round and round.
Scenario long_lab(std::uint64_t seed, double minutes);

}  // namespace azimuth
