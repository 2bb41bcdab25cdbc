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

/// rig.toml as text, which is recorded, and as what it says.
struct RigFile {
  std::string file;
  std::string toml;
  Rig rig;
};

/// Where samples come from, and what belongs to them.
struct Origin {
  std::vector<std::unique_ptr<Source>> sources;
  bool needs_perception = false;  ///< the bearings are to be found in images
  RigFile rig;
  std::optional<Duration> epoch_minus_monotonic;  ///< none: the stamps are those of a recording
  Stamp first_stamp{};                            ///< of a recording
  std::string description;
};

/// The recording that is to be played.
FileResult<Origin> recorded_origin(const DaemonSettings& daemon);
/// The robot's own sensors, which need not be there yet.
FileResult<Origin> live_origin(const DaemonSettings& daemon);

}  // namespace azimuth
