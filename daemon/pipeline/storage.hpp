#pragma once
// Storage circulates between the stages, so every piece is reserved large enough before the threads start.

#include <memory>
#include <vector>

#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Storage for the path. The publisher sends the storage to the estimator as a request for the path, and the storage
/// comes back with the path, or empty.
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
