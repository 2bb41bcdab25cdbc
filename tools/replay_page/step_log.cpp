#include "tools/replay_page/step_log.hpp"

#include <algorithm>

#include "slam/estimator/innovations.hpp"

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
  const Innovations innovations = innovations_of(expected_, estimate.accepted);
  step.compared = innovations.compared;
  step.nis = innovations.nis;
  expected_.clear();
  seen_ = 0;
}

}  // namespace azimuth
