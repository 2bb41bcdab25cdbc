#pragma once
#include <string>

#include "drivers/storage/map_file.hpp"

namespace azimuth {

/// What a saved map is, for a person.
std::string map_summary(const LoadedMap& loaded);

/// Likewise for a program: one JSON object.
std::string map_summary_json(const LoadedMap& loaded);

}  // namespace azimuth
