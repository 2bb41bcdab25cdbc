#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "daemon/config/daemon_settings.hpp"
#include "daemon/pipeline/source.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// rig.toml as text, which is recorded, and as parsed values.
struct RigFile {
  std::string file;
  std::string toml;
  Rig rig;
};

/// The sources of samples and the data that belong to them.
struct Origin {
  std::vector<std::unique_ptr<Source>> sources;
  bool needs_perception = false;  ///< true: the bearings must be detected in images
  RigFile rig;
  std::optional<Duration> epoch_minus_monotonic;  ///< none: the stamps are those of a recording
  Stamp first_stamp{};                            ///< first stamp of a recording
  std::string description;
};

/// The origin for the recording that is to be played.
FileResult<Origin> recorded_origin(const DaemonSettings& daemon);
/// The origin for the robot's own sensors. They need not be connected yet.
FileResult<Origin> live_origin(const DaemonSettings& daemon);

}  // namespace azimuth
