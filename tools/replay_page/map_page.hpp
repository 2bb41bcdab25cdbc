#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// A saved map in the same form as page_run(), with empty columns since there is no drive.
nlohmann::ordered_json page_of_map(const MapSnapshot& map, const std::string& name);

}  // namespace azimuth
