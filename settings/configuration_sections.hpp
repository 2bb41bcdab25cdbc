#pragma once
// The tables of azimuth.toml, bound to the settings that they fill. Internal to settings/.

#include <vector>

#include "settings/configuration.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// Every table of azimuth.toml except that of the colours (colour_section.hpp). `configuration` must outlive the
/// tables.
std::vector<Section> estimator_sections(Configuration& configuration);

}  // namespace azimuth
