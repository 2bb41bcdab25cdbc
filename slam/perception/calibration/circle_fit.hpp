#pragma once
#include "slam/perception/calibration/ring_profile.hpp"

namespace azimuth {

/// A circle fitted to edge points, in pixels of the edge map.
struct CircleFit {
  ImageCircle ring;
  double sigma_centre = 0.0;  ///< Standard deviation of the centre in its worst direction
  double sigma_radius = 0.0;
  double seen = 0.0;    ///< Share of the rays inside the map that found the edge on the circle
  double in_map = 0.0;  ///< Share of the circle that lies inside the map
};

/// Fits a circle by robust least squares to the strongest edges near `start`, on rays in all directions. The fit is
/// repeated with a narrowing search window. `seen` is 0 if there is no circle.
CircleFit fit_circle(const EdgeMap& map, const ImageCircle& start);

}  // namespace azimuth
