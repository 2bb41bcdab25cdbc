#pragma once
#include <optional>
#include <string>

#include "tools/export/estimated.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// The path as a line ("path"), with a time for each of its places, and a point for each landmark with its covariance
/// and the axes of its ellipse of one standard deviation. Frames and ids are those of map_geojson(). A path across the
/// antimeridian is cut there, as RFC 7946 has it.
std::string path_geojson(const Estimated& estimated, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
