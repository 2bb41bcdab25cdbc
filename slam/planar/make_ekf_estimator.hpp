#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/planar/ekf_settings.hpp"

namespace azimuth {

/// The bearing-only EKF (SPEC part I) for a rig.
std::unique_ptr<Estimator> make_ekf_estimator(const Rig& rig, const EkfSettings& settings, const MapStart& start = {});
/// Why it cannot start from `map`; nothing: it can.
std::optional<std::string_view> why_unfit_for_ekf(const MapSnapshot& map, const Rig& rig);

}  // namespace azimuth
