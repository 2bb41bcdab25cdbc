#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The predicted bearing of a mapped landmark.
struct ExpectedBearing {
  std::int64_t landmark = 0;  ///< its id in the map
  Kind kind = kAnyKind;
  double azimuth_rad = 0.0;  ///< as Bearing::azimuth_rad
  double gate_rad = 0.0;     ///< gate: largest difference of a matching bearing
  // Predicted elevation, as Bearing::elevation_rad, and its gate; NaN: no prediction.
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();
  double gate_elevation_rad = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the azimuth's innovation; NaN: unknown.
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();
  int rejected_in_row = 0;  ///< number of its bearings rejected since the last accepted one
};

/// Whether a bearing may belong to the landmark. Kind and elevation are compared where both sides have them.
inline bool explains(const ExpectedBearing& expected, const Bearing& seen) {
  // A comparison with NaN is false.
  const bool too_high_or_low =
      std::abs(seen.elevation_rad - expected.elevation_rad) > std::abs(expected.gate_elevation_rad);
  return same_kind(expected.kind, seen.kind) && !too_high_or_low &&
         std::abs(wrap(seen.azimuth_rad - expected.azimuth_rad)) <= expected.gate_rad;
}

}  // namespace azimuth
