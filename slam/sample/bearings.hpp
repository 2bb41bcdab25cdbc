#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The name a sensor gives to what it sees (a barcode, a colour tag). kUnknownIdentity: it cannot tell.
using Identity = std::int64_t;
inline constexpr Identity kUnknownIdentity = -1;

/// One direction in the robot's frame.
struct Bearing {
  double azimuth_rad = 0.0;  ///< counter-clockwise from the robot's heading, in [-pi, pi)
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();  ///< up from the horizontal; NaN: not measured
  Identity identity = kUnknownIdentity;
};

/// Room that storage for the bearings of one image starts with.
inline constexpr std::size_t kTypicalBearings = 32;

/// All bearings of one instant (one image). May be empty: an image in which nothing was found.
struct BearingSet {
  Stamp stamp{};
  std::uint64_t sequence = 0;  ///< counts sets at their source; a gap means sets were lost
  std::vector<Bearing> bearings;
};

}  // namespace azimuth
