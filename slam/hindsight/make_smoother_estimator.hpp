#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/hindsight/task_runner.hpp"
#include "slam/hypotheses/workers.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Factories of the workers that run beside the thread that asks for the pose. Estimates do not depend on them.
struct Helpers {
  /// Makes the workers that process hypotheses in parallel on `threads` threads.
  std::function<std::unique_ptr<Workers>(int threads)> make_workers = [](int /*threads*/) {
    return std::make_unique<InTurn>();
  };
  /// Makes the background task that processes all hypotheses while odometry extrapolates the pose.
  std::function<std::unique_ptr<TaskRunner>()> make_task_runner = [] { return std::make_unique<AtOnce>(); };
};

/// Makes the smoother estimator for landmarks in the plane. It uses identities if the rig's bearings carry them,
/// otherwise hypotheses.
std::unique_ptr<Estimator> make_smoother_estimator(const Rig& rig, const HindsightSettings& settings,
                                                   const MapStart& start = {}, const HealthSettings& health = {},
                                                   const RelocalisationSettings& relocalisation = {},
                                                   const Helpers& helpers = {});

/// Combines a filter for that rig with a graph of the bearings that the filter accepts: see WithHindsight.
std::unique_ptr<Estimator> make_with_hindsight(std::unique_ptr<Estimator> filter, const Rig& rig,
                                               const HindsightSettings& settings);

/// The reason why the smoother estimator cannot start from `map`; empty if it can.
std::optional<std::string_view> why_unfit_for_smoother(const MapSnapshot& map, const Rig& rig,
                                                       const HindsightSettings& settings, const MapStart& start);

}  // namespace azimuth
