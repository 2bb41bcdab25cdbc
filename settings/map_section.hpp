#pragma once
#include "settings/section.hpp"
#include "slam/estimator/map_start.hpp"

namespace azimuth {

/// The table [map] of azimuth.toml, bound to `start`, which must outlive it.
Section map_section(MapStart& start);

}  // namespace azimuth
