#pragma once
#include "slam/perception/calibration/ring_profile.hpp"

namespace azimuth {

/// A circle through edge points, in pixels of the map.
struct CircleFit {
  ImageCircle ring;
  double sigma_centre = 0.0;  ///< standard deviation in the worst direction
  double sigma_radius = 0.0;
  double seen = 0.0;    ///< share of the rays in the map that found the edge on the circle
  double in_map = 0.0;  ///< share of the circle
};

/// Fits to the strongest edges along `start` on rays all round, by robust least squares, again and again in a window
/// that narrows. Share 0 seen: there is no circle.
CircleFit fit_circle(const EdgeMap& map, const ImageCircle& start);

}  // namespace azimuth
