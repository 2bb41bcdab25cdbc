#include "daemon/saved_odometry.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {
namespace {

bool is_same(const MapLandmark& a, const MapLandmark& b) {
  return a.id == b.id && a.identity == b.identity && a.p_map_landmark_m == b.p_map_landmark_m &&
         a.has_height() == b.has_height() && (!a.has_height() || a.z_map_landmark_m == b.z_map_landmark_m);
}

}  // namespace

SavedOdometry saved_odometry(const LoadedMap& map, const std::filesystem::path& file, const StampClock& clock) {
  const auto unknown = [](const char* why) {
    return SavedOdometry{.kept = {}, .text = std::string("where the robot went since then is not known: ") + why};
  };
  const char* why = "no odometry was kept";
  std::optional<KeptOdometry> newest;
  const std::uint32_t checksum = map_checksum(map.bytes);
  for (std::optional<KeptOdometry>& kept : read_kept_odometry(kept_odometry_file(file))) {
    if (!kept) continue;
    const bool is_of_map = kept->map_checksum == checksum && kept->since.map == map.map.stamp;
    if (is_of_map) kept = on_clock(*std::move(kept), clock);
    if (!is_of_map)
      why = "the odometry that was kept belongs to another map";
    else if (!kept)
      why = "the machine was switched off, or slept";
    else if (!newest || newest->since.reading.stamp < kept->since.reading.stamp)
      newest = std::move(kept);
  }
  if (!newest) return unknown(why);
  return {.kept = std::move(newest),
          .text = "where the robot went since then its odometer will say, if it has counted on"};
}

std::optional<LoadedMap> map_with_robot(const LoadedMap& map, const std::filesystem::path& file) {
  FileResult<LoadedMap> located = read_map(located_map(file));
  if (!located || located->map.names != map.map.names) return std::nullopt;
  if (!std::ranges::equal(located->map.landmarks, map.map.landmarks, is_same)) return std::nullopt;
  return *std::move(located);
}

}  // namespace azimuth
