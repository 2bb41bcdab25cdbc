#pragma once
#include <optional>

#include "daemon/keep/map_keeper.hpp"
#include "drivers/io/map_file.hpp"
#include "settings/configuration.hpp"
#include "settings/outcome.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// What the daemon starts with: a map, or the reason for none.
struct SavedMap {
  std::optional<LoadedMap> loaded;
  MapKeeperStatus status;
};

/// Loads what `settings` names, if it is there. A map that is damaged, with the one before it as well, is no reason not
/// to start mapping (what cannot be read is not overwritten, see write_map()), but one to localise. A sound map of
/// another kind than the estimator's is refused: it would be lost.
Outcome<SavedMap> saved_map(const MapSettings& settings, const Configuration& configuration, const Rig& rig);

}  // namespace azimuth
