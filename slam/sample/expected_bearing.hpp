#pragma once
#include <cstdint>
#include <limits>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Where a mapped landmark is expected to be seen, before anybody looks.
struct ExpectedBearing {
  std::int64_t landmark = 0;  ///< its id in the map
  Kind kind = kAnyKind;
  double azimuth_rad = 0.0;  ///< as Bearing::azimuth_rad
  double gate_rad = 0.0;     ///< a bearing farther off than this is not of it
  // As Bearing::elevation_rad, and its gate; NaN: nothing is expected of it.
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();
  double gate_elevation_rad = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace azimuth
