#pragma once
#include <cstdint>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// What becomes of the map an estimator starts from.
enum class MapMode : std::uint8_t {
  localise,  ///< it stays as it is to the last bit, and the robot only looks for itself in it
  extend,    ///< it is corrected and grows
};

/// How an estimator starts from a saved map.
struct MapStart {
  const MapSnapshot* map = nullptr;  ///< borrowed for the construction only; null: from nothing
  MapMode mode = MapMode::extend;
  /// The robot is where the map saw it last, give or take: else it can be anywhere, facing anywhere.
  bool pose_known = false;
  double sigma_position_m = 0.3;  ///< how far it may have been moved since, along each axis; while the pose is known
  double sigma_heading_rad = 0.2;
  /// Whether the odometry goes on, and with it the pose, will be said by Estimator::odometry_begins(); until then
  /// nothing is decided. If it does not, all is as it would be without this.
  bool asks_odometry = false;
  /// While the pose is not known: how far from where the map saw the robot last it can be; 0: anywhere.
  double reach_m = 0.0;
};

}  // namespace azimuth
