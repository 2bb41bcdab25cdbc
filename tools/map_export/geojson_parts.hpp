#pragma once
// What maps and paths have in common as GeoJSON. Reentrant.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace azimuth {

using GeoJson = nlohmann::ordered_json;

/// Where the map's frame lies on the globe.
struct MapOrigin {
  double latitude_deg = 0.0;   ///< WGS 84, of the map's origin; short of the poles
  double longitude_deg = 0.0;  ///< east
  double heading_deg = 0.0;    ///< of the map's x axis, clockwise from north
};

/// "LAT,LON[,HEADING]" in degrees; nothing when it is not that, or not on the globe.
std::optional<MapOrigin> map_origin(const std::string& text);

/// Turns map coordinates into what GeoJSON wants: see map_geojson().
class GeoPlacement {
 public:
  explicit GeoPlacement(const std::optional<MapOrigin>& origin);

  /// Two numbers, or three; a height that is not finite is left out.
  GeoJson position(const Eigen::Vector2d& p_map_m, double z_m) const;
  GeoJson point(const Eigen::Vector2d& p_map_m, double z_m) const;

 private:
  std::optional<MapOrigin> origin_;
  double north_m_per_deg_ = 0.0, east_m_per_deg_ = 0.0;
};

/// Rows of numbers.
GeoJson covariance_json(const Eigen::MatrixXd& P);
/// Semi-axes of one standard deviation, the larger one first, and where that one points.
GeoJson ellipse_json(const Eigen::Matrix2d& P);

/// Features with what their coordinates are. Whoever goes by RFC 7946 alone takes all coordinates for degrees on WGS
/// 84; GDAL and what is built on it believe the older member "crs" where it says that there is none, and show the name.
GeoJson geojson_collection(const std::optional<MapOrigin>& origin, GeoJson features);

}  // namespace azimuth
