#pragma once
// Geometric reasoning (SPEC I.13): a landmark that is at most so far from wherever it is seen, and lies on the ray it
// was seen along before, can now only be seen within an interval of directions.

#include <Eigen/Core>
#include <optional>

namespace azimuth {

/// Directions from the present position, in the map frame: from `start_rad` by `sweep_rad` (signed, at most pi).
struct ViewInterval {
  double start_rad = 0.0;
  double sweep_rad = 0.0;

  /// Whether a direction lies in it, widened by `margin_rad` at both ends.
  bool contains(double direction_rad, double margin_rad) const;
};

/// Where a landmark can be seen from `p_map_now_m` that was seen from `p_map_before_m` in the direction
/// `direction_before_rad` (map frame: heading + azimuth) when nothing farther away than `max_distance_m` is seen.
/// Nothing: it cannot be seen from there at all.
std::optional<ViewInterval> view_interval(const Eigen::Vector2d& p_map_before_m, double direction_before_rad,
                                          const Eigen::Vector2d& p_map_now_m, double max_distance_m);

/// The margin at three standard deviations: two bearings, and how far the robot's heading may have turned otherwise
/// than it is believed to.
double view_margin_rad(double variance_before_rad2, double variance_now_rad2, double variance_turn_rad2);

}  // namespace azimuth
