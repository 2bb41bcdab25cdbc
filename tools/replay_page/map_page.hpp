#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// A saved map as the page of a replay shows a run (page_run()): nothing was driven, its columns are empty.
nlohmann::ordered_json page_of_map(const MapSnapshot& map, const std::string& name);

}  // namespace azimuth
