#pragma once
// A run through the very stage the daemon runs, without threads and as fast as it goes.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/io/run.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

struct ReplayResult {
  std::vector<EstimateRecord> estimates;  ///< one for each step
  Estimate last;                          ///< with the final map; as constructed when there was no step
  std::uint64_t digest = 0;               ///< see EstimateDigest
  StepTimes times;
};

/// Told how many of the run's bearing sets have been given to the estimator.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

/// Truth is not looked at. Same run, rig and estimator: the same estimates to the last bit; only times differ.
ReplayResult replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                    const Progress& progress = {});

}  // namespace azimuth
