#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

/// Makes the bearing-only EKF (mathematics part I) for a rig.
std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {},
                                              const HealthSettings& health = {},
                                              const RelocalisationSettings& relocalisation = {});
/// Why the EKF cannot start from `map`. Nothing when it can.
std::optional<std::string_view> why_unfit_for_ekf(const MapSnapshot& map, const Rig& rig);

}  // namespace azimuth
