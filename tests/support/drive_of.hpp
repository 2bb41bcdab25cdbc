#pragma once
// Converts a run to the drive that the commands would receive.

#include <memory>

#include "drivers/storage/run.hpp"
#include "settings/rig.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth::test {

inline Drive drive_of(const Run& run, const Rig& rig) {
  Drive drive;
  replay(run, rig, std::make_unique<DriveListener>(drive), with_patience({}));
  drive.odometry = run.odometry;
  return drive;
}

inline Rig rig_of_run(const Run& run) { return read_rig(run.rig_toml, "rig.toml").value(); }

}  // namespace azimuth::test
