#pragma once
#include <optional>
#include <string>

#include "base/file_result.hpp"
#include "daemon/config/daemon_settings.hpp"
#include "daemon/config/options.hpp"
#include "daemon/keep/map_keeper.hpp"
#include "daemon/origin.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "drivers/storage/kept_odometry.hpp"
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

/// The checked configuration, and the objects made from it before any thread starts.
struct DaemonSetup {
  Configuration configuration;
  DaemonSettings daemon;
  Origin origin;
  std::optional<PerceptionStage> perception;  ///< none: the sources send ready-made bearings
  SavedMap saved;
  SavedOdometry odometry = {};  ///< filled in by find_odometry(), after the process that kept it has ended

  bool plays() const { return !daemon.play.run.empty(); }
};

/// Reads configuration, rig, recording and saved map. On failure, returns all errors of the first of these that is
/// wrong. Opens no device.
FileResult<DaemonSetup> read_setup(const Options& options);

/// Like read_setup(), while the daemon is running. go_on_with_map() must follow, so a saved map that requires a known
/// pose is no error here.
FileResult<DaemonSetup> read_setup_anew(const Options& options);

/// For --check-config. Returns one line that tells what was checked and found correct, and one line for each warning;
/// on failure, all errors. A configuration without a source of samples is correct.
FileResult<std::string> check_setup(const Options& options);

/// Finds the odometry kept beside the setup's map, and gives the odometer its part of it. Call it last before the
/// start, when any earlier pipeline has ended.
void find_odometry(DaemonSetup& setup);

/// The state that a pipeline leaves to its successor.
struct Bequest {
  std::optional<MapSnapshot> map;  ///< none: no step was made since the start, or the robot was lost
  bool pose_known = false;         ///< the map's pose of the robot was correct
  bool lost = false;
};

/// Makes a setup continue with the map of the previous setup if that map fits the new rig and estimator. Otherwise the
/// setup uses the map in its map file, or no map. `setup.saved.status` tells which.
void go_on_with_map(DaemonSetup& setup, const DaemonSetup& before, Bequest bequest);

}  // namespace azimuth
