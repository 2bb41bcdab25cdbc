#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

/// The EKF over lamps in space, for a rig whose bearings carry elevations.
std::unique_ptr<Estimator> make_lamp_ekf_estimator(const Rig& rig, const LampEkfSettings& settings,
                                                   const MapStart& start = {},
                                                   const RelocalisationSettings& relocalisation = {});
/// Why it cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit_for_lamp_ekf(const MapSnapshot& map, const Rig& rig);

}  // namespace azimuth
