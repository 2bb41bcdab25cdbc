#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/errand.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/hypotheses/workers.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Makes who does the work beside the thread that asks for the pose, where there is enough of it. Whoever it is, the
/// estimates are the same.
struct Helpers {
  /// Of hypotheses, side by side, on so many threads.
  std::function<std::unique_ptr<Workers>(int threads)> make_workers = [](int /*threads*/) {
    return std::make_unique<InTurn>();
  };
  /// Of all of them, while the pose goes on by odometry.
  std::function<std::unique_ptr<Errand>()> make_errand = [] { return std::make_unique<AtOnce>(); };
};

/// The smoother over landmarks in the plane: by their names where the rig's bearings carry some, by hypotheses where
/// not.
std::unique_ptr<Estimator> make_smoother_estimator(const Rig& rig, const HindsightSettings& settings,
                                                   const MapStart& start = {}, const HealthSettings& health = {},
                                                   const RelocalisationSettings& relocalisation = {},
                                                   const Helpers& helpers = {});

/// Any filter for that rig, and a graph of what it accepts: see WithHindsight.
std::unique_ptr<Estimator> make_with_hindsight(std::unique_ptr<Estimator> filter, const Rig& rig,
                                               const HindsightSettings& settings);

/// Why it cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit_for_smoother(const MapSnapshot& map, const Rig& rig,
                                                       const HindsightSettings& settings, const MapStart& start);

}  // namespace azimuth
