#pragma once
#include <span>
#include <string>

#include "settings/section.hpp"

namespace azimuth {

/// Every key of `sections` as TOML, commented out at its present value, with its help and range: the reference that
/// is printed, and the configuration that is shipped. Removing the `#` before a key gives a valid file.
///
/// Without those of experts a table of none but theirs is left out.
std::string reference(std::span<Section* const> sections, Tier down_to = Tier::expert);

}  // namespace azimuth
