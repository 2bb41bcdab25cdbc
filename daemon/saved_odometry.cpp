#include "daemon/saved_odometry.hpp"

#include <utility>

namespace azimuth {

SavedOdometry saved_odometry(const LoadedMap& map, const std::filesystem::path& file, const StampClock& clock) {
  const auto unknown = [](const char* why) {
    return SavedOdometry{.kept = {}, .text = std::string("where the robot went since then is not known: ") + why};
  };
  std::optional<KeptOdometry> kept = read_kept_odometry(kept_odometry_file(file));
  if (!kept) return unknown("no odometry was kept");
  if (kept->map_checksum != map_checksum(map.bytes) || kept->since.map != map.map.stamp)
    return unknown("the odometry that was kept belongs to another map");
  kept = on_clock(*std::move(kept), clock);
  if (!kept) return unknown("the machine was switched off, or slept");
  return {.kept = std::move(kept),
          .text = "where the robot went since then its odometer will say, if it has counted on"};
}

}  // namespace azimuth
