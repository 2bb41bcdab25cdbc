#pragma once
#include <optional>

#include "base/file_result.hpp"
#include "daemon/keep/map_keeper.hpp"
#include "drivers/storage/map_file.hpp"
#include "settings/configuration.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The map that the daemon starts with, or the reason why it has none.
struct SavedMap {
  std::optional<LoadedMap> loaded;
  /// The map requires a known pose, so a start can use it only if the odometer has continued to count: see
  /// find_odometry().
  bool needs_pose = false;
  MapKeeperStatus status;
};

/// Loads the map that `settings` names, if it exists. If both the map and its predecessor are damaged, a start for
/// mapping continues without a map; a start for localisation fails. The same holds for a sound map that requires a
/// known pose, because a restarted service must run. Neither kind of map is overwritten: see write_map() and
/// MapKeeperStatus::unfit. A sound map of another kind than the estimator's is refused.
FileResult<SavedMap> saved_map(const MapSettings& settings, const Configuration& configuration, const Rig& rig);

/// The status for a map that the estimator has started from.
MapKeeperStatus started_from(const LoadedMap& map);

/// Largest distance [m] of a robot from the pose in its map, when the map is `age` old. 0: unlimited, for maps that are
/// not recent or whose stamp is in the future. Thread contract: reentrant.
double reach_since(Duration age, const MapSettings& settings);

}  // namespace azimuth
