#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// Makes the EKF over 3D lamps, for a rig whose bearings have elevations.
std::unique_ptr<Estimator> make_lamp_ekf_estimator(const Rig& rig, const LampEkfSettings& settings,
                                                   const MapStart& start = {}, const HealthSettings& health = {},
                                                   const RelocalisationSettings& relocalisation = {});
/// The reason why the estimator cannot start from `map`; nullopt if it can.
std::optional<std::string_view> why_unfit_for_lamp_ekf(const MapSnapshot& map, const Rig& rig);

}  // namespace azimuth
