#pragma once
// Clips lines to a frame, so that files contain no invisible parts and no numbers too large for renderers.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace azimuth {

using PlotLine = std::vector<Eigen::Vector2d>;

/// A rectangle including its borders, in the unit of its context.
struct Box {
  Eigen::Vector2d low{0.0, 0.0};
  Eigen::Vector2d high{0.0, 0.0};
  bool contains(const Eigen::Vector2d& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
};

/// The pieces of `line` inside `box`, in order. A point that is not finite, or has absurdly large coordinates, ends a
/// piece.
std::vector<PlotLine> clipped(std::span<const Eigen::Vector2d> line, const Box& box);

/// The line without points that are nearer than `step` to the last kept point. The first and last points are kept.
PlotLine thinned(std::span<const Eigen::Vector2d> line, double step);

}  // namespace azimuth
