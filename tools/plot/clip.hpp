#pragma once
// What of a line is inside of a frame, so that a file holds nothing that is not seen, and no number that a renderer
// cannot hold.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace azimuth {

using PlotLine = std::vector<Eigen::Vector2d>;

/// A rectangle, borders included; in whatever unit its holder says.
struct Box {
  Eigen::Vector2d low{0.0, 0.0};
  Eigen::Vector2d high{0.0, 0.0};
  bool contains(const Eigen::Vector2d& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
};

/// The pieces of `line` that lie in `box`, in their order. A point that is not finite, or absurdly far off, ends a
/// piece: it is no place to draw a line to.
std::vector<PlotLine> clipped(std::span<const Eigen::Vector2d> line, const Box& box);

/// Without points that are nearer than `step` to the last one kept; the first and the last always stay.
PlotLine thinned(std::span<const Eigen::Vector2d> line, double step);

}  // namespace azimuth
