#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/perception/colour/colour_run.hpp"

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

}  // namespace azimuth
