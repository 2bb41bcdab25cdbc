#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/perception/colour/colour_run.hpp"

namespace azimuth {

/// From the image's centre, in pixels as wide as high.
using CentredPoint = Eigen::Vector2d;

/// From columns and rows of samples to points about the image's centre: sample (0, 0) is at `origin_px`, its
/// neighbours `step_px` further on.
struct SampleGrid {
  CentredPoint origin_px = CentredPoint::Zero();
  Eigen::Vector2d step_px = Eigen::Vector2d::Ones();

  CentredPoint point(double column, double row) const {
    return origin_px + step_px.cwiseProduct(Eigen::Vector2d(column, row));
  }
};

/// Replaces `out` by the middles of all sides of samples at which the blob made of `runs` ends, those of holes
/// included. `runs` by rows from above, then from left to right.
void outline_of(std::span<const ColourRun> runs, const SampleGrid& grid, std::vector<CentredPoint>& out);

}  // namespace azimuth
