#pragma once
#include <optional>
#include <string>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// Where the map's frame lies on the globe.
struct MapOrigin {
  double latitude_deg = 0.0;   ///< WGS 84, of the map's origin; short of the poles
  double longitude_deg = 0.0;  ///< east
  double heading_deg = 0.0;    ///< of the map's x axis, clockwise from north
};

/// "LAT,LON[,HEADING]" in degrees; nothing when it is not that, or not on the globe.
std::optional<MapOrigin> map_origin(const std::string& text);

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
