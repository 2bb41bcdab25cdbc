#pragma once
#include <cstdint>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// What happens to the map that an estimator starts from.
enum class MapMode : std::uint8_t {
  localise,  ///< The map stays the same to the last bit; only the robot is localised in it
  extend,    ///< The map is corrected and grows
};

/// How an estimator starts from a saved map.
struct MapStart {
  const MapSnapshot* map = nullptr;  ///< Borrowed for the construction only; null: no saved map
  MapMode mode = MapMode::extend;
  /// The robot is near the pose saved in the map. Otherwise it can be anywhere, with any heading.
  bool pose_known = false;
  /// If `pose_known`: standard deviation of a displacement since the save, along each axis
  double sigma_position_m = 0.3;
  double sigma_heading_rad = 0.2;
  /// Whether odometry, and with it the pose, continues from the saved map is decided by Estimator::odometry_begins();
  /// until then no start pose is set. If odometry does not continue, the start is the same as without this flag.
  bool asks_odometry = false;
  /// If the pose is not known: greatest distance from the saved pose; 0: anywhere.
  double reach_m = 0.0;
};

}  // namespace azimuth
