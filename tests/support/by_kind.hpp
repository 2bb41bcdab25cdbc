#pragma once
// Runs whose bearings have names, as a front end would have them that tells kinds apart, but not things.

#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/eye_tracks.hpp"

namespace azimuth::test {

/// Named by eye. Each landmark is one of `kinds`.
inline Drive seen_by_kind(const Run& run, const Rig& rig, Kind kinds = 4) {
  Drive drive = drive_of(run, rig);
  for (BearingSet& set : drive.sets)
    for (Bearing& bearing : set.bearings) {
      bearing.kind = static_cast<Kind>(bearing.identity % kinds);
      bearing.identity = kUnknownIdentity;
    }
  drive.names_are_landmarks = false;
  name_by_eye(drive, rig.odometry);
  return drive;
}

}  // namespace azimuth::test
