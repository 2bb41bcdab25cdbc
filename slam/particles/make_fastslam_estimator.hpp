#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Makes a FastSLAM estimator (mathematics part II) for a rig whose bearings carry elevations.
std::unique_ptr<Estimator> make_fastslam_estimator(const Rig& rig, const FastSlamSettings& settings,
                                                   const MapStart& start = {}, const HealthSettings& health = {},
                                                   const RelocalisationSettings& relocalisation = {});
/// The reason why the estimator cannot start from `map`; empty if it can.
std::optional<std::string_view> why_unfit_for_fastslam(const MapSnapshot& map, const Rig& rig,
                                                       const FastSlamSettings& settings);

}  // namespace azimuth
