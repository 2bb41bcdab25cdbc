#pragma once
#include <optional>
#include <string>

#include "tools/export/estimated.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// The path as a line with the id "path" and a time for each position, and a point for each landmark with its
/// covariance and the axes of its one-sigma ellipse. Frames and ids are those of map_geojson(). A path across the
/// antimeridian is split there, as RFC 7946 requires.
std::string path_geojson(const Estimated& estimated, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
