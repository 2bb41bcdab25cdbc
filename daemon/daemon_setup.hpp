#pragma once
#include <optional>
#include <string>

#include "base/file_result.hpp"
#include "daemon/config/daemon_settings.hpp"
#include "daemon/config/options.hpp"
#include "daemon/origin.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "daemon/saved_map.hpp"
#include "daemon/saved_odometry.hpp"
#include "settings/configuration.hpp"

namespace azimuth {

/// Everything the daemon was told, checked, and all that is made of it before a thread starts.
struct DaemonSetup {
  Configuration configuration;
  DaemonSettings daemon;
  Origin origin;
  std::optional<PerceptionStage> perception;  ///< none: bearings come ready made
  SavedMap saved;
  SavedOdometry odometry = {};  ///< once the process that kept it has ended: see find_odometry()

  bool plays() const { return !daemon.play.run.empty(); }
};

/// Reads configuration, rig, recording and saved map: all that is wrong with the first of them that is. Opens no
/// device.
FileResult<DaemonSetup> read_setup(const Options& options);

/// Likewise while the daemon runs: go_on_with_map() is to follow, so a map that can be started from only by a robot
/// that knows where it is is no mistake.
FileResult<DaemonSetup> read_setup_anew(const Options& options);

/// For --check-config: a line that says what has been looked at and found right, or all that is wrong. A configuration
/// without a source of samples is right. A further line for each warning.
FileResult<std::string> check_setup(const Options& options);

/// Looks for the odometry that the setup's map goes on with, and gives the odometer its part of it. The last thing
/// before the start: a pipeline before this one has ended.
void find_odometry(DaemonSetup& setup);

/// What a pipeline that ended leaves to the next one.
struct Bequest {
  std::optional<MapSnapshot> map;  ///< none: no step since the start, or the robot was lost
  bool pose_known = false;         ///< the robot was where the map says
  bool lost = false;
};

/// Lets a setup go on with the map of the one before it if that fits the new rig and estimator; else with the one in
/// its map file, or from nothing. What becomes of the map is said in `setup.saved.status`.
void go_on_with_map(DaemonSetup& setup, const DaemonSetup& before, Bequest bequest);

}  // namespace azimuth
