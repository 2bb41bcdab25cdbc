#pragma once
#include <span>
#include <string>

#include "settings/section.hpp"

namespace azimuth {

/// Returns every key of `sections` as TOML, commented out at its present value, with its help and range. The text is
/// both the printed reference and the shipped configuration. Removing the `#` before a key gives a valid file.
std::string reference(std::span<Section* const> sections);

}  // namespace azimuth
