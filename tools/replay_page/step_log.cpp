#include "tools/replay_page/step_log.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {

void StepLog::before_update(const BearingSet& set, const Estimator& estimator) {
  estimator.expect(expected_);
  std::ranges::sort(expected_, {}, &ExpectedBearing::landmark);
  seen_ = set.bearings.size();
}

void StepLog::after_step(const Estimate& estimate) {
  PageStep& step = steps_.emplace_back();
  step.seen = seen_;
  step.counts = estimate.association;
  for (const AcceptedSighting& sighting : estimate.accepted) {
    const auto expected = std::ranges::lower_bound(expected_, sighting.landmark_id, {}, &ExpectedBearing::landmark);
    if (expected == expected_.end() || expected->landmark != sighting.landmark_id) continue;
    const double deviation = wrap(sighting.azimuth_rad - expected->azimuth_rad) / expected->sigma_rad;
    if (!std::isfinite(deviation)) continue;
    ++step.compared;
    step.nis += deviation * deviation;
  }
  expected_.clear();
  seen_ = 0;
}

}  // namespace azimuth
