#pragma once
// A run through the very stage the daemon runs, without threads and as fast as it goes.

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
#include "slam/estimator/past_pose.hpp"
#include "slam/estimator/rig.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/evaluate/sighting_error.hpp"
#include "tools/evaluate/trajectory.hpp"
#include "tools/replay/set_source.hpp"

namespace azimuth {

/// What became of a run's images.
struct ImageOutcome {
  std::size_t images = 0;                        ///< 0: the run brought bearings
  std::map<ImageTrouble, std::size_t> troubles;  ///< of sets, recorded ones included; `none` is not counted
  std::string first_unreadable;                  ///< file and reason; empty: all could be read
};

struct ReplayResult {
  std::vector<EstimateRecord> estimates;  ///< one for each step
  std::vector<StepHealth> healths;        ///< likewise
  std::vector<SightingRecord> sightings;  ///< accepted, in the robot's frame
  Estimate last;                          ///< with the final map; as constructed when there was no step
  std::vector<PastPose> past;             ///< in hindsight; empty: the estimator has none
  std::optional<MapSnapshot> map;         ///< the final one; nothing: there is none worth keeping
  std::uint64_t digest = 0;               ///< see EstimateDigest
  SampleFinding samples;                  ///< what kept them from being of use
  StepTimes times;
  ImageOutcome images;
};

/// Who looks on; either may be empty. What they take is no part of a step's time.
struct ReplayWatch {
  EstimatorStage::BeforeUpdate before_update = {};
  std::function<void(const Estimate&)> after_step = {};
};

/// What is made of the past at the end.
enum class Ending : std::uint8_t {
  as_in_the_daemon,  ///< nothing: past and map are what the last step left
  concluded,         ///< all that there is to know: see Estimator::conclude(); `last` has its landmarks then
};

/// `progress` counts the bearing sets, or images, that have been given to the estimator. Truth is not looked at. Same
/// run, rig and estimator: the same estimates to the last bit; only times differ.
ReplayResult replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                    const Progress& progress = {}, Ending ending = Ending::as_in_the_daemon,
                    const ReplayWatch& watch = {});

/// The same with the bearings that `front_end` finds in the run's images, one image at a time.
ReplayResult replay_images(const Run& run, const Rig& rig, ImageFrontEnd front_end,
                           std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                           const Progress& progress = {}, Ending ending = Ending::as_in_the_daemon,
                           const ReplayWatch& watch = {});

}  // namespace azimuth
