#pragma once
#include <string>

#include "settings/section.hpp"

namespace azimuth {

/// Writes the `given` keys at their present values below the table's header, or all elements and keys of a list.
/// Reading the text gives the same values.
std::string toml_text(const Section& section);

}  // namespace azimuth
