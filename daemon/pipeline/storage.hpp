#pragma once
// Storage goes round between the stages, so every piece of it starts out large enough.

#include "slam/estimator/estimate.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

inline void prepare(BearingSet& set) { set.bearings.reserve(kTypicalBearings); }

inline void prepare(Estimate& estimate) {
  estimate.landmarks.reserve(kTypicalLandmarks);
  estimate.accepted.reserve(kTypicalLandmarks);
}

}  // namespace azimuth
