#pragma once
// Iterates over the bearing sets of a recorded run, for measurements without an estimator stage.

#include <cstddef>

#include "drivers/storage/run.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Calls `each(set, step)` for every set, with the motion since the previous one.
template <class Each>
void for_each_step(const Run& run, const Rig& rig, const Each& each) {
  OdometryTrack track(rig.odometry);
  std::size_t read = 0;
  for (const BearingSet& set : run.bearings) {
    while (read < run.odometry.size() && (track.empty() || track.newest() < set.stamp)) track.add(run.odometry[read++]);
    each(set, track.advance_to(set.stamp));
  }
}

}  // namespace azimuth
