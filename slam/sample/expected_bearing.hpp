#pragma once
#include <cstdint>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Where a mapped landmark is expected to be seen, before anybody looks.
struct ExpectedBearing {
  std::int64_t landmark = 0;  ///< its id in the map
  Kind kind = kAnyKind;
  double azimuth_rad = 0.0;  ///< as Bearing::azimuth_rad
  double gate_rad = 0.0;     ///< a bearing farther off than this is not of it
};

}  // namespace azimuth
