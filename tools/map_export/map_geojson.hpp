#pragma once
#include <optional>
#include <string>

#include "slam/sample/map_snapshot.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// The map as a GeoJSON FeatureCollection: a point for each landmark, with its covariance and the axes of its ellipse
/// of one standard deviation, and one for the robot's last pose. Ids are texts, a landmark's number or "robot":
/// programs that find numbers and a text mixed (GDAL) number the robot like a landmark.
///
/// With an origin, coordinates are longitude and latitude as RFC 7946 has them: on the ellipsoid's tangent plane at the
/// origin, which is right to centimetres within some kilometres, longitudes from -180 to 180 degrees. Without one they
/// are metres in the map's own frame, which the members "crs" (null) and "name" say to other programs, and
/// "azimuth:frame" in any case.
std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
