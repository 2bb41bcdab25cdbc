#pragma once
// The table [[colour.class]] of azimuth.toml.

#include <string>
#include <vector>

#include "settings/section.hpp"
#include "slam/perception/colour/colour_settings.hpp"

namespace azimuth {

/// The table of the colour classes, bound to `colour`, which must outlive the table.
Section colour_section(ColourSettings& colour);

/// The text of `classes` in the notation of azimuth.toml.
std::string colour_classes_text(std::vector<ColourClass> classes);

}  // namespace azimuth
