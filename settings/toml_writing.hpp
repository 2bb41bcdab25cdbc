#pragma once
#include <string>

#include "settings/section.hpp"

namespace azimuth {

/// The keys that are `given`, at their present values, below the table's header; all of a list, whether given or not.
/// Reads as itself.
std::string toml_text(const Section& section);

}  // namespace azimuth
