#include "tools/map_export/map_geojson.hpp"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/principal_axes.hpp"
#include "tools/map_export/own_covariance.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

// WGS 84
constexpr double kEquator_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
constexpr double kMostLatitude_deg = 89.0;  // nearer to a pole the tangent plane's degrees of longitude run away

/// A map across the antimeridian goes on at the other end: longitudes end at 180 degrees.
double within_a_half_turn_deg(double longitude_deg) { return std::remainder(longitude_deg, 360.0); }

/// Turns map coordinates into what GeoJSON wants.
class Placement {
 public:
  explicit Placement(const std::optional<MapOrigin>& origin) : origin_(origin) {
    if (!origin) return;
    const double e2 = kFlattening * (2.0 - kFlattening), s = std::sin(degrees_to_rad(origin->latitude_deg));
    const double prime_vertical_m = kEquator_m / std::sqrt(1.0 - e2 * s * s);
    const double meridian_m = prime_vertical_m * (1.0 - e2) / (1.0 - e2 * s * s);
    north_m_per_deg_ = degrees_to_rad(meridian_m);
    east_m_per_deg_ = degrees_to_rad(prime_vertical_m * std::cos(degrees_to_rad(origin->latitude_deg)));
  }

  Json point(const Eigen::Vector2d& p_map_m, double z_m) const {
    Json coordinates = {p_map_m.x(), p_map_m.y()};
    if (origin_) {
      const double heading_rad = degrees_to_rad(origin_->heading_deg), c = std::cos(heading_rad),
                   s = std::sin(heading_rad);
      const double north_m = c * p_map_m.x() + s * p_map_m.y(), east_m = s * p_map_m.x() - c * p_map_m.y();
      coordinates = {within_a_half_turn_deg(origin_->longitude_deg + east_m / east_m_per_deg_),
                     origin_->latitude_deg + north_m / north_m_per_deg_};
    }
    if (std::isfinite(z_m)) coordinates.push_back(z_m);
    return {{"type", "Point"}, {"coordinates", coordinates}};
  }

 private:
  std::optional<MapOrigin> origin_;
  double north_m_per_deg_ = 0.0, east_m_per_deg_ = 0.0;
};

Json covariance_json(const Eigen::MatrixXd& P) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < P.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < P.cols(); ++c) row.push_back(P(r, c));
    rows.push_back(row);
  }
  return rows;
}

/// Semi-axes of one standard deviation, the larger one first, and where that one points.
Json ellipse(const Eigen::Matrix2d& P) {
  const PrincipalAxes axes = principal_axes(P);
  const Eigen::Vector2d major = axes.directions.col(1);
  return {{"semi_major_m", std::sqrt(std::max(axes.eigenvalues(1), 0.0))},
          {"semi_minor_m", std::sqrt(std::max(axes.eigenvalues(0), 0.0))},
          {"major_direction_rad", std::atan2(major.y(), major.x())}};
}

Json landmark_feature(const MapLandmark& landmark, const Eigen::Matrix3d& P, const Placement& placement) {
  Json properties = {{"what", "landmark"}, {"landmark_id", landmark.id}, {"sightings", landmark.sightings}};
  if (landmark.identity != kUnknownIdentity) properties["identity"] = landmark.identity;
  if (landmark.kind != kAnyKind) properties["kind"] = landmark.kind;
  const auto size = static_cast<Eigen::Index>(landmark.size());
  properties["covariance_m2"] = covariance_json(P.topLeftCorner(size, size));
  properties["ellipse"] = ellipse(P.topLeftCorner<2, 2>());
  return {{"type", "Feature"},
          {"id", std::to_string(landmark.id)},
          {"geometry", placement.point(landmark.p_map_landmark_m, landmark.z_map_landmark_m)},
          {"properties", properties}};
}

Json robot_feature(const MapSnapshot& map, const Placement& placement) {
  Eigen::Matrix3d P;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      P(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = map.covariance(r, c);
  return {{"type", "Feature"},
          {"id", "robot"},
          {"geometry", placement.point(map.T_map_body.position(), std::nan(""))},
          {"properties",
           {{"what", "robot"},
            {"utime", to_us(map.stamp)},
            {"heading_rad", map.T_map_body.heading_rad},
            {"covariance", covariance_json(P)}}}};
}

/// Whoever goes by RFC 7946 alone takes all coordinates for degrees on WGS 84; GDAL and what is built on it believe the
/// older member "crs" where it says that there is none, and show the name.
Json collection(const std::optional<MapOrigin>& origin) {
  if (origin) return {{"type", "FeatureCollection"}};
  return {{"type", "FeatureCollection"}, {"name", "map_frame_in_metres"}, {"crs", nullptr}};
}

Json frame(const std::optional<MapOrigin>& origin) {
  if (!origin) return {{"coordinates", "map"}, {"unit", "m"}};
  return {{"coordinates", "WGS 84"},
          {"origin_latitude_deg", origin->latitude_deg},
          {"origin_longitude_deg", origin->longitude_deg},
          {"x_axis_heading_deg", origin->heading_deg}};
}

}  // namespace

std::optional<MapOrigin> map_origin(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    at = next;
    if (at == end) break;
    if (*at++ != ',') return std::nullopt;
  }
  if (numbers.size() < 2 || numbers.size() > 3) return std::nullopt;
  if (std::abs(numbers[0]) > kMostLatitude_deg || std::abs(numbers[1]) > 180.0) return std::nullopt;
  return MapOrigin{numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0.0};
}

std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin) {
  const Placement placement(origin);
  Json features = Json::array();
  for_each_landmark(map, [&](const MapLandmark& landmark, const Eigen::Matrix3d& P) {
    features.push_back(landmark_feature(landmark, P, placement));
  });
  features.push_back(robot_feature(map, placement));
  Json all = collection(origin);
  all["azimuth:frame"] = frame(origin);
  all["features"] = features;
  return all.dump(1) + '\n';
}

}  // namespace azimuth
