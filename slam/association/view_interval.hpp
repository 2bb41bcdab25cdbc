#pragma once
// Geometric constraint on features (mathematics I.13): a landmark is seen from a limited distance only and lies on the
// ray of an earlier bearing, so from the present position it can be seen only within an interval of directions.

#include <Eigen/Core>
#include <optional>

namespace azimuth {

/// Directions from the present position, in the map frame: from `start_rad` through `sweep_rad` (signed, at most pi).
struct ViewInterval {
  double start_rad = 0.0;
  double sweep_rad = 0.0;

  /// Whether a direction is in the interval, widened by `margin_rad` at both ends.
  bool contains(double direction_rad, double margin_rad) const;
};

/// Directions from `p_map_now_m` in which a landmark can be seen that was seen from `p_map_before_m` in the direction
/// `direction_before_rad` (map frame: heading + azimuth), if landmarks are seen up to `max_distance_m` only. Nothing
/// when it cannot be seen at all.
std::optional<ViewInterval> view_interval(const Eigen::Vector2d& p_map_before_m, double direction_before_rad,
                                          const Eigen::Vector2d& p_map_now_m, double max_distance_m);

/// The margin at three standard deviations, due to the two bearings and the error of the robot's turn between them.
double view_margin_rad(double variance_before_rad2, double variance_now_rad2, double variance_turn_rad2);

}  // namespace azimuth
