#pragma once
#include "settings/section.hpp"
#include "slam/estimator/health_settings.hpp"

namespace azimuth {

/// The table [health], bound to `health`.
Section health_section(HealthSettings& health);

}  // namespace azimuth
