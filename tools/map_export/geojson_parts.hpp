#pragma once
// Common parts of the GeoJSON export of maps and paths. Reentrant.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace azimuth {

using GeoJson = nlohmann::ordered_json;

/// Position and orientation of the map frame on the globe.
struct MapOrigin {
  double latitude_deg = 0.0;   ///< latitude of the map's origin (WGS 84), not near a pole
  double longitude_deg = 0.0;  ///< longitude of the map's origin, positive to the east
  double heading_deg = 0.0;    ///< direction of the map's x axis, clockwise from north
};

/// Parses "LAT,LON[,HEADING]" in degrees; nothing if the text is malformed or out of range.
std::optional<MapOrigin> map_origin(const std::string& text);

/// Converts map coordinates to GeoJSON coordinates: see map_geojson().
class GeoPlacement {
 public:
  explicit GeoPlacement(const std::optional<MapOrigin>& origin);

  /// A position of two or three numbers; a height that is not finite is omitted.
  GeoJson position(const Eigen::Vector2d& p_map_m, double z_m) const;
  GeoJson point(const Eigen::Vector2d& p_map_m, double z_m) const;

 private:
  std::optional<MapOrigin> origin_;
  double north_m_per_deg_ = 0.0, east_m_per_deg_ = 0.0;
};

/// The matrix as an array of rows.
GeoJson covariance_json(const Eigen::MatrixXd& P);
/// Semi-axes of the one-sigma ellipse, the larger one first, and the direction of the larger one.
GeoJson ellipse_json(const Eigen::Matrix2d& P);

/// A FeatureCollection with a description of its coordinates. RFC 7946 defines all coordinates as degrees on WGS 84.
/// For metric coordinates, the older member "crs" is null; GDAL and programs that use it respect this and show the
/// name.
GeoJson geojson_collection(const std::optional<MapOrigin>& origin, GeoJson features);

}  // namespace azimuth
