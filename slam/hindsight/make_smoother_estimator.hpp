#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/hypotheses/workers.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// The smoother over landmarks in the plane: by their names where the rig's bearings carry some, by hypotheses where
/// not, whose members `workers` look after.
std::unique_ptr<Estimator> make_smoother_estimator(const Rig& rig, const HindsightSettings& settings,
                                                   const MapStart& start = {}, const HealthSettings& health = {},
                                                   const RelocalisationSettings& relocalisation = {},
                                                   std::unique_ptr<Workers> workers = std::make_unique<InTurn>());

/// Why it cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit_for_smoother(const MapSnapshot& map, const Rig& rig,
                                                       const HindsightSettings& settings, const MapStart& start);

}  // namespace azimuth
