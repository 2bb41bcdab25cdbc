#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "slam/geometry/angle.hpp"
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
  /// Standard deviation of what an azimuth is off by that is of it; NaN: nobody can tell.
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();
  int rejected_in_row = 0;  ///< bearings that were taken for it and refused, since the last one that was used
};

/// Whether a bearing may be of the landmark, as far as either knows kind and elevation.
inline bool explains(const ExpectedBearing& expected, const Bearing& seen) {
  // Comparing with what is not there is false.
  const bool too_high_or_low =
      std::abs(seen.elevation_rad - expected.elevation_rad) > std::abs(expected.gate_elevation_rad);
  return same_kind(expected.kind, seen.kind) && !too_high_or_low &&
         std::abs(wrap(seen.azimuth_rad - expected.azimuth_rad)) <= expected.gate_rad;
}

}  // namespace azimuth
