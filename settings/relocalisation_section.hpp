#pragma once
// The table [relocalisation] of azimuth.toml.

#include "settings/section.hpp"
#include "slam/localisation/relocalisation_settings.hpp"

namespace azimuth {

Section relocalisation_section(RelocalisationSettings& relocalisation);

}  // namespace azimuth
