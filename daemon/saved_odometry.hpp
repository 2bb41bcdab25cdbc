#pragma once
#include <optional>
#include <string>

#include "drivers/storage/kept_odometry.hpp"
#include "drivers/storage/map_file.hpp"

namespace azimuth {

/// How the robot had gone on from where its map was saved, or the reason why nobody knows.
struct SavedOdometry {
  std::optional<KeptOdometry> kept;  ///< on this process's clock
  std::string text;                  ///< for a person
};

/// Of what is kept beside `map`, when that is the map which was kept at `file`. Thread contract: reentrant.
SavedOdometry saved_odometry(const LoadedMap& map, const std::filesystem::path& file, const StampClock& clock);

/// The same landmarks as in `map`, the map at `file`, with where a robot was that only localised in it; nothing: none
/// did, or in another map. Thread contract: reentrant.
std::optional<LoadedMap> map_with_robot(const LoadedMap& map, const std::filesystem::path& file);

}  // namespace azimuth
