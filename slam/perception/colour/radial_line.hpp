#pragma once
#include <span>

#include "slam/perception/colour/outline.hpp"

namespace azimuth {

/* The line through the image's centre with the least squared lateral error of all points (SPEC I.11),
 *
 *   angle = 1/2 atan2(2 S_xy, S_xx - S_yy), S the second moments about the centre,
 *
 * and of its two directions the one towards the points' centroid.
 */
/// In [-pi, pi), from u towards v; 0 without points.
double radial_line_rad(std::span<const CentredPoint> points);

}  // namespace azimuth
