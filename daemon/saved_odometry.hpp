#pragma once
#include <optional>
#include <string>

#include "drivers/storage/kept_odometry.hpp"
#include "drivers/storage/map_file.hpp"

namespace azimuth {

/// The motion of the robot since its map was saved, or the reason why it is unknown.
struct SavedOdometry {
  std::optional<KeptOdometry> kept;  ///< with stamps on this process's clock
  std::string text;                  ///< for a person
};

/// Reads the odometry kept beside `map`, if `map` is the map that was kept at `file`. Thread contract: reentrant.
SavedOdometry saved_odometry(const LoadedMap& map, const std::filesystem::path& file, const StampClock& clock);

/// Returns the landmarks of `map`, the map at `file`, with the pose of a robot that only localised itself in it. None:
/// no robot did, or it used another map. Thread contract: reentrant.
std::optional<LoadedMap> map_with_robot(const LoadedMap& map, const std::filesystem::path& file);

}  // namespace azimuth
