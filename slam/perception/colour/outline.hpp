#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/perception/colour/scan.hpp"

namespace azimuth {

/// A point relative to the image centre, in square pixels.
using CentredPoint = Eigen::Vector2d;

/// Maps columns and rows of samples to points about the image centre: sample (0, 0) is at `origin_px`, neighbouring
/// samples are `step_px` apart.
struct SampleGrid {
  CentredPoint origin_px = CentredPoint::Zero();
  Eigen::Vector2d step_px = Eigen::Vector2d::Ones();

  CentredPoint point(double column, double row) const {
    return origin_px + step_px.cwiseProduct(Eigen::Vector2d(column, row));
  }
};

/// Replaces the content of `out` with the midpoints of all sample sides on the outline of the blob made of `runs`,
/// holes included. `runs` must be sorted by row from above, then from left to right.
void outline_of(std::span<const ColourRun> runs, const SampleGrid& grid, std::vector<CentredPoint>& out);

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
