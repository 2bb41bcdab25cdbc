#pragma once

namespace azimuth {

/// Prior of the image's centre, which the filter estimates wherever bearings come from images.
struct CentreSettings {
  double sigma_px = 10.0;  ///< Initial standard deviation along u and along v; 0: the rig's centre is exact
  /// The map is rebuilt once from the same images when the standard deviation of the centre falls below this value
  /// (second_start.hpp); 0: never. Only maps of lamps and of coloured landmarks are rebuilt.
  double second_start_px = 1.0;

  friend bool operator==(const CentreSettings&, const CentreSettings&) = default;
};

}  // namespace azimuth
