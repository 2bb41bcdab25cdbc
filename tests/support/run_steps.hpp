#pragma once
// A recorded run bearing set by bearing set, for what is measured without an estimator's stage.

#include <cstddef>

#include "drivers/storage/run.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Calls `each(set, step)` for every set, with the motion since the one before.
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
