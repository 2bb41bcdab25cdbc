#pragma once
#include <optional>

#include "base/file_result.hpp"
#include "daemon/keep/map_keeper.hpp"
#include "drivers/storage/map_file.hpp"
#include "settings/configuration.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// What the daemon starts with: a map, or the reason for none.
struct SavedMap {
  std::optional<LoadedMap> loaded;
  /// Only a robot that knows where it is can start from it, because its odometer has counted on: see find_odometry().
  bool needs_pose = false;
  MapKeeperStatus status;
};

/// Loads what `settings` names, if it is there. A map that is damaged, with the one before it as well, is no reason not
/// to start mapping, but one to localise; nor is a sound one that only a robot could start from that knows where it is:
/// a service that was restarted has to run. Neither is overwritten, see write_map() and MapKeeperStatus::unfit. A sound
/// map of another kind than the estimator's is refused.
FileResult<SavedMap> saved_map(const MapSettings& settings, const Configuration& configuration, const Rig& rig);

/// What is said of a map that the estimator started from.
MapKeeperStatus started_from(const LoadedMap& map);

/// How far from where its map saw it last a robot can be at most [m], of a map that is `age` old. 0: anywhere, as for
/// maps that are not recent, or seem to be of the future. Thread contract: reentrant.
double reach_since(Duration age, const MapSettings& settings);

}  // namespace azimuth
