#pragma once
// Storage goes round between the stages, so every piece of it starts out large enough.

#include <memory>
#include <vector>

#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/past_pose.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Goes from the publisher to the estimator as a request for the path, and comes back with it, or empty.
using PathStorage = std::unique_ptr<std::vector<PathPose>>;

inline void prepare(BearingSet& set) { set.bearings.reserve(kTypicalBearings); }

inline void prepare(Estimate& estimate) {
  estimate.landmarks.reserve(kTypicalLandmarks);
  estimate.accepted.reserve(kTypicalLandmarks);
}

inline void prepare(StepResult& result) {
  prepare(result.estimate);
  result.expected.bearings.reserve(kTypicalLandmarks);
}

}  // namespace azimuth
