#pragma once
#include <span>

#include "slam/perception/colour/outline.hpp"

namespace azimuth {

/* Finds the line through the image centre with the least sum of squared lateral distances to all points (mathematics
 * I.11),
 *
 *   angle = 1/2 atan2(2 S_xy, S_xx - S_yy), where S are the second moments about the centre.
 *
 * Of the line's two directions, the one towards the centroid of the points is returned.
 */
/// In [-pi, pi), measured from u towards v; 0 without points.
double radial_line_rad(std::span<const CentredPoint> points);

}  // namespace azimuth
