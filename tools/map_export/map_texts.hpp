#pragma once
// Saved maps as texts, for other programs and for people.

#include <optional>
#include <string>

#include "drivers/storage/map_file.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// The landmarks as a table with one line each. The first columns are those of landmarks.csv in run folders; further
/// columns contain the properties of the landmark and the covariance of its coordinates. Numbers are written without
/// loss. Unknown values are empty.
std::string map_csv(const MapSnapshot& map);

/// The map as a GeoJSON FeatureCollection: a point for each landmark, with its covariance and the axes of its one-sigma
/// ellipse, and a point for the robot's last pose. All ids are texts, the landmark's id or "robot". If ids were a
/// mixture of numbers and texts, GDAL would give the robot a number like a landmark.
///
/// With an origin, coordinates are longitude and latitude as RFC 7946 requires, computed on the tangent plane of the
/// ellipsoid at the origin. This is accurate to centimetres within some kilometres. Longitudes are from -180 to 180
/// degrees. Without an origin, coordinates are metres in the map frame; the members "crs" (null) and "name" tell other
/// programs so. The member "azimuth:frame" states the frame in both cases.
std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin);

/// Description of a saved map as text for the user.
std::string map_summary(const LoadedMap& loaded);

/// Description of a saved map as one JSON object.
std::string map_summary_json(const LoadedMap& loaded);

}  // namespace azimuth
