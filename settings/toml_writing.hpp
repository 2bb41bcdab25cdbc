#pragma once
#include <span>
#include <string>

#include "settings/section.hpp"

namespace azimuth {

/// Writes the `given` keys at their present values below the table's header, or all elements and keys of a list.
/// Reading the text gives the same values.
std::string toml_text(const Section& section);

/// Returns every key of `sections` as TOML, commented out at its present value, with its help and range. The text is
/// both the printed reference and the shipped configuration. Removing the `#` before a key gives a valid file.
std::string reference(std::span<Section* const> sections);

}  // namespace azimuth
