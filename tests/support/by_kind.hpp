#pragma once
// Runs whose bearings are named as by a front end that tells kinds of landmark apart, but not individual landmarks.

#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/eye_tracks.hpp"

namespace azimuth::test {

/// The drive with names from name_by_eye(). Each landmark has one of `kinds` kinds.
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
