#pragma once
// Processes a run with the same EstimatorStage as the daemon, without threads and as fast as possible.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "drivers/storage/run.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/sighting_error.hpp"
#include "tools/evaluate/trajectory.hpp"
#include "tools/replay/set_source.hpp"

namespace azimuth {

/// Statistics of a run's images.
struct ImageOutcome {
  std::size_t images = 0;                        ///< 0 if the run contains bearings instead of images
  std::map<ImageTrouble, std::size_t> troubles;  ///< numbers of bearing sets by trouble, except `none`
  std::string first_unreadable;                  ///< file and reason; empty if all images were readable
};

struct ReplayResult {
  std::vector<EstimateRecord> estimates;  ///< one for each step
  std::vector<StepHealth> healths;        ///< one for each step
  std::vector<SightingRecord> sightings;  ///< accepted bearings in the robot's frame
  Estimate last;                          ///< last estimate with the final map; default value if there was no step
  std::vector<PastPose> past;             ///< smoothed path; empty if the estimator provides none
  std::optional<MapSnapshot> map;         ///< final map; nothing if the estimator saves none
  std::uint64_t digest = 0;               ///< see EstimateDigest
  SampleFinding samples;                  ///< reasons why samples were unusable
  StepTimes times;
  ImageOutcome images;
};

/// Observers of a replay; each may be empty. Their computing time does not count as time of a step.
struct ReplayWatch {
  EstimatorStage::BeforeUpdate before_update = {};
  std::function<void(const Estimate&)> after_step = {};
};

/// Treatment of the past at the end of the run.
enum class Ending : std::uint8_t {
  as_in_the_daemon,  ///< no further optimisation: past and map are those after the last step
  concluded,         ///< final optimisation by Estimator::conclude(); `last` then contains the resulting landmarks
};

/// `progress` counts the bearing sets or images given to the estimator. Truth is not used. The same run, rig and
/// estimator give bit-identical estimates; only times differ.
ReplayResult replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                    const Progress& progress = {}, Ending ending = Ending::as_in_the_daemon,
                    const ReplayWatch& watch = {});

/// As replay(), with the bearings that `front_end` detects in the run's images.
ReplayResult replay_images(const Run& run, const Rig& rig, ImageFrontEnd front_end,
                           std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                           const Progress& progress = {}, Ending ending = Ending::as_in_the_daemon,
                           const ReplayWatch& watch = {});

}  // namespace azimuth
