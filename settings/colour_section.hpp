#pragma once
// The tables [colour] and [[colour.class]] of azimuth.toml.

#include <string>
#include <vector>

#include "settings/section.hpp"
#include "slam/perception/colour/colour_settings.hpp"

namespace azimuth {

/// In this order.
std::vector<Section> colour_sections(ColourSettings& colour);

/// Some classes as they stand in azimuth.toml.
std::string colour_classes_text(std::vector<ColourClass> classes);

}  // namespace azimuth
