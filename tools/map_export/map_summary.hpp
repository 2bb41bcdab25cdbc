#pragma once
#include <string>

#include "drivers/storage/map_file.hpp"

namespace azimuth {

/// Description of a saved map as text for the user.
std::string map_summary(const LoadedMap& loaded);

/// Description of a saved map as one JSON object.
std::string map_summary_json(const LoadedMap& loaded);

}  // namespace azimuth
