#pragma once
#include <cstddef>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/expected_bearing.hpp"

namespace azimuth {

/// What a step did with the bearings it was given.
struct PageStep {
  std::size_t seen = 0;      ///< bearings of the set
  std::size_t compared = 0;  ///< accepted ones of landmarks whose expected azimuth and its deviation were known before
  /// Of those, the squared differences in standard deviations, summed: normalised innovations squared, elevations left
  /// out. One compared bearing gives 1 on the average where the estimate is honest.
  double nis = 0.0;
  AssociationCounts counts;  ///< since the start of the run
};

/// Looks on at a replay, and remembers of each step what its result does not say.
///
/// Thread contract: thread-bound.
class StepLog {
 public:
  void before_update(const BearingSet& set, const Estimator& estimator);
  void after_step(const Estimate& estimate);

  /// One for each estimate.
  const std::vector<PageStep>& steps() const { return steps_; }

 private:
  std::vector<ExpectedBearing> expected_;  // sorted by landmark
  std::size_t seen_ = 0;
  std::vector<PageStep> steps_;
};

}  // namespace azimuth
