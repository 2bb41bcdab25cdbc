#include "daemon/saved_map.hpp"

#include <fmt/format.h>
#include <utility>

#include "settings/configured_estimator.hpp"

namespace azimuth {
namespace {

FileError cannot_localise(const MapSettings& settings, std::string why) {
  return {settings.file, 0, std::move(why) + ", and map.mode = \"localise\" needs a map"};
}

std::string one_line(const FileErrors& errors) {
  std::string line;
  for (const FileError& error : errors) line += (line.empty() ? "" : "; ") + error.text();
  return line;
}

}  // namespace

FileResult<SavedMap> saved_map(const MapSettings& settings, const Configuration& configuration, const Rig& rig) {
  SavedMap saved;
  const bool localises = configuration.map.mode == MapMode::localise;
  if (settings.file.empty()) return saved;
  if (!map_exists(settings.file)) {
    if (localises) return failure(cannot_localise(settings, "is not there"));
    saved.status.text = settings.file + ": not there yet";
    return saved;
  }
  FileResult<LoadedMap> loaded = read_map(settings.file);
  if (!loaded) {
    if (localises) return failure(cannot_localise(settings, one_line(loaded.error())));
    saved.status = {.text = one_line(loaded.error()) + "; mapping starts from nothing", .trouble = true};
    return saved;
  }
  if (const auto unfit = why_unfit(loaded->map, rig, configuration)) {
    Configuration knowing = configuration;
    knowing.map.pose_known = true;
    const bool wants_pose = !why_unfit(loaded->map, rig, knowing);
    if (localises || !wants_pose)
      return failure(FileError{loaded->file.string(), 0, "cannot be started from: " + std::string(*unfit)});
    saved.status = {
        .text = fmt::format("{}: cannot be started from: {}; mapping starts from nothing, and the map is set aside",
                            loaded->file.string(), *unfit),
        .trouble = true,
        .unfit = true};
    saved.needs_pose = true;
    saved.loaded = *std::move(loaded);
    return saved;
  }
  saved.status = started_from(*loaded);
  saved.loaded = *std::move(loaded);
  return saved;
}

MapKeeperStatus started_from(const LoadedMap& map) {
  MapKeeperStatus status{
      .text = fmt::format("{}: started from its {} landmarks", map.file.string(), map.map.landmarks.size())};
  if (map.troubles.empty()) return status;
  status.text = one_line(map.troubles) + "; " + status.text;
  status.trouble = true;
  return status;
}

double reach_since(Duration age, const MapSettings& settings) {
  constexpr double kSlack_m = 1.0;  // the pose in the map is not exact either
  if (age < Duration{0} || settings.recent_s <= 0.0 || to_seconds(age) > settings.recent_s) return 0.0;
  return kSlack_m + settings.fastest_m_per_s * to_seconds(age);
}

}  // namespace azimuth
