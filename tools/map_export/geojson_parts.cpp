#include "tools/map_export/geojson_parts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/principal_axes.hpp"

namespace azimuth {
namespace {

// WGS 84
constexpr double kEquator_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
constexpr double kMostLatitude_deg = 89.0;  // nearer to a pole than this, longitudes on the tangent plane diverge

/// Wraps a longitude to [-180, 180] degrees, for maps across the antimeridian.
double within_a_half_turn_deg(double longitude_deg) { return std::remainder(longitude_deg, 360.0); }

GeoJson frame(const std::optional<MapOrigin>& origin) {
  if (!origin) return {{"coordinates", "map"}, {"unit", "m"}};
  return {{"coordinates", "WGS 84"},
          {"origin_latitude_deg", origin->latitude_deg},
          {"origin_longitude_deg", origin->longitude_deg},
          {"x_axis_heading_deg", origin->heading_deg}};
}

}  // namespace

GeoPlacement::GeoPlacement(const std::optional<MapOrigin>& origin) : origin_(origin) {
  if (!origin) return;
  const double e2 = kFlattening * (2.0 - kFlattening), s = std::sin(degrees_to_rad(origin->latitude_deg));
  const double prime_vertical_m = kEquator_m / std::sqrt(1.0 - e2 * s * s);
  const double meridian_m = prime_vertical_m * (1.0 - e2) / (1.0 - e2 * s * s);
  north_m_per_deg_ = degrees_to_rad(meridian_m);
  east_m_per_deg_ = degrees_to_rad(prime_vertical_m * std::cos(degrees_to_rad(origin->latitude_deg)));
}

GeoJson GeoPlacement::position(const Eigen::Vector2d& p_map_m, double z_m) const {
  GeoJson coordinates = {p_map_m.x(), p_map_m.y()};
  if (origin_) {
    const double heading_rad = degrees_to_rad(origin_->heading_deg), c = std::cos(heading_rad),
                 s = std::sin(heading_rad);
    const double north_m = c * p_map_m.x() + s * p_map_m.y(), east_m = s * p_map_m.x() - c * p_map_m.y();
    coordinates = {within_a_half_turn_deg(origin_->longitude_deg + east_m / east_m_per_deg_),
                   origin_->latitude_deg + north_m / north_m_per_deg_};
  }
  if (std::isfinite(z_m)) coordinates.push_back(z_m);
  return coordinates;
}

GeoJson GeoPlacement::point(const Eigen::Vector2d& p_map_m, double z_m) const {
  return {{"type", "Point"}, {"coordinates", position(p_map_m, z_m)}};
}

GeoJson covariance_json(const Eigen::MatrixXd& P) {
  GeoJson rows = GeoJson::array();
  for (Eigen::Index r = 0; r < P.rows(); ++r) {
    GeoJson row = GeoJson::array();
    for (Eigen::Index c = 0; c < P.cols(); ++c) row.push_back(P(r, c));
    rows.push_back(row);
  }
  return rows;
}

GeoJson ellipse_json(const Eigen::Matrix2d& P) {
  const PrincipalAxes axes = principal_axes(P);
  const Eigen::Vector2d major = axes.directions.col(1);
  return {{"semi_major_m", std::sqrt(std::max(axes.eigenvalues(1), 0.0))},
          {"semi_minor_m", std::sqrt(std::max(axes.eigenvalues(0), 0.0))},
          {"major_direction_rad", std::atan2(major.y(), major.x())}};
}

GeoJson geojson_collection(const std::optional<MapOrigin>& origin, GeoJson features) {
  GeoJson all = {{"type", "FeatureCollection"}};
  if (!origin) {
    all["name"] = "map_frame_in_metres";
    all["crs"] = nullptr;
  }
  all["azimuth:frame"] = frame(origin);
  all["features"] = std::move(features);
  return all;
}

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

}  // namespace azimuth
