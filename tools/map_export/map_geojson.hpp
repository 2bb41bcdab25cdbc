#pragma once
#include <optional>
#include <string>

#include "slam/sample/map_snapshot.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// The map as a GeoJSON FeatureCollection: a point for each landmark, with its covariance and the axes of its one-sigma
/// ellipse, and a point for the robot's last pose. All ids are texts, the landmark's id or "robot". If ids were a
/// mixture of numbers and texts, GDAL would give the robot a number like a landmark.
///
/// With an origin, coordinates are longitude and latitude as RFC 7946 requires, computed on the tangent plane of the
/// ellipsoid at the origin. This is accurate to centimetres within some kilometres. Longitudes are from -180 to 180
/// degrees. Without an origin, coordinates are metres in the map frame; the members "crs" (null) and "name" tell other
/// programs so. The member "azimuth:frame" states the frame in both cases.
std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
