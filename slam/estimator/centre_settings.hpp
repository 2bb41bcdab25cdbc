#pragma once

namespace azimuth {

/// The image's centre, a state wherever bearings come from images.
struct CentreSettings {
  double sigma_px = 10.0;  ///< initial standard deviation along u and along v; 0: the rig's centre is exact
  /// The map is begun anew from the same images, once, when they have told the centre to this standard deviation
  /// (second_start.hpp); 0: never. Only maps of lamps and of coloured landmarks are.
  double second_start_px = 1.0;

  friend bool operator==(const CentreSettings&, const CentreSettings&) = default;
};

}  // namespace azimuth
