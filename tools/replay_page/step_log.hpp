#pragma once
#include <cstddef>
#include <vector>

#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Use of the bearings in one step.
struct PageStep {
  std::size_t seen = 0;      ///< number of bearings in the set
  std::size_t compared = 0;  ///< accepted bearings whose expected azimuth and its deviation were known beforehand
  /// Sum of the normalised innovations squared (NIS) of the compared bearings, without elevations. Its mean per bearing
  /// is 1 if the estimate is consistent.
  double nis = 0.0;
  AssociationCounts counts;  ///< since the start of the run
};

/// Observes a replay and records data of each step that ReplayResult does not contain.
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
