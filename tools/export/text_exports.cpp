#include "tools/export/text_exports.hpp"

#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "drivers/wire/number_text.hpp"

namespace azimuth {
namespace {

/// True if the segment crosses the antimeridian.
bool crosses(const GeoJson& before, const GeoJson& after, bool on_the_globe) {
  return on_the_globe && std::abs(after[0].get<double>() - before[0].get<double>()) > 180.0;
}

/// Completes a line. Since a line needs at least two positions, a single one is duplicated.
void close_line(GeoJson& lines) {
  GeoJson& line = lines.back();
  if (line.size() == 1) line.push_back(GeoJson(line[0]));
}

GeoJson lines_of(const std::vector<PathPose>& path, const GeoPlacement& placement, bool on_the_globe) {
  GeoJson lines = GeoJson::array();
  for (const PathPose& pose : path) {
    GeoJson place = placement.position(pose.T_map_body.position(), std::nan(""));
    if (lines.empty() || crosses(lines.back().back(), place, on_the_globe)) {
      if (!lines.empty()) close_line(lines);
      lines.push_back(GeoJson::array());
    }
    lines.back().push_back(std::move(place));
  }
  if (!lines.empty()) close_line(lines);
  return lines;
}

GeoJson path_feature(const Estimated& estimated, const GeoPlacement& placement, bool on_the_globe) {
  const std::vector<PathPose> path = path_of(estimated);
  GeoJson lines = lines_of(path, placement, on_the_globe), geometry, utimes = GeoJson::array();
  for (const PathPose& pose : path) utimes.push_back(to_us(pose.stamp));
  const bool whole = lines.size() == 1;
  geometry["type"] = whole ? "LineString" : "MultiLineString";
  geometry["coordinates"] = whole ? GeoJson(lines[0]) : std::move(lines);
  return {{"type", "Feature"},
          {"id", "path"},
          {"geometry", std::move(geometry)},
          {"properties", {{"what", "path"}, {"run", estimated.run}, {"utimes", std::move(utimes)}}}};
}

GeoJson landmark_point(const LandmarkEstimate& landmark, const GeoPlacement& placement) {
  GeoJson properties = {{"what", "landmark"}, {"landmark_id", landmark.id}};
  if (landmark.identity != kUnknownIdentity) properties["identity"] = landmark.identity;
  properties["covariance_m2"] = covariance_json(landmark.covariance_m2);
  properties["ellipse"] = ellipse_json(landmark.covariance_m2);
  if (std::isfinite(landmark.sigma_z_m)) properties["sigma_z_m"] = landmark.sigma_z_m;
  return {{"type", "Feature"},
          {"id", std::to_string(landmark.id)},
          {"geometry", placement.point(landmark.p_map_landmark_m, landmark.z_map_landmark_m)},
          {"properties", std::move(properties)}};
}

/// A T A^-1, where A converts robot axes to camera axes: x_c = -y_r, y_c = -z_r, z_c = x_r.
std::array<double, 12> camera_pose(const Pose2& T) {
  const double c = std::cos(T.heading_rad), s = std::sin(T.heading_rad);
  return {c, 0.0, -s, 0.0 - T.y_m, 0.0, 1.0, 0.0, 0.0, s, 0.0, c, T.x_m};
}

constexpr const char* kColumns =
    "t_s,x_m,y_m,heading_rad,var_x_m2,var_y_m2,var_heading_rad2,cov_xy_m2,cov_x_heading_m_rad,cov_y_heading_m_rad,"
    "odom_x_m,odom_y_m,odom_heading_rad,health,reason\n";

void append_numbers(std::string& line, std::initializer_list<double> values) {
  for (const double value : values) {
    line += ',';
    append_double(line, value);
  }
}

std::string in_quotes(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char letter : text) out += letter == '"' ? "\"\"" : std::string(1, letter);
  return out + '"';
}

}  // namespace

std::string poses_csv(const Estimated& estimated) {
  std::string table = kColumns;
  for (const EstimatedPose& pose : estimated.poses) {
    const Pose2& T = pose.T_map_body;
    const Eigen::Matrix3d& P = pose.covariance;
    append_seconds(table, pose.stamp);
    append_numbers(table, {T.x_m, T.y_m, T.heading_rad, P(0, 0), P(1, 1), P(2, 2), P(1, 0), P(2, 0), P(2, 1)});
    if (const auto& odom = pose.T_odom_body)
      append_numbers(table, {odom->x_m, odom->y_m, odom->heading_rad});
    else
      table += ",,,";
    table += ',';
    if (pose.health) table += to_string(*pose.health);
    table += ',' + in_quotes(pose.reason) + '\n';
  }
  return table;
}

std::string kitti_text(const Estimated& estimated) {
  std::string text;
  for (const EstimatedPose& pose : estimated.poses) {
    char separator = '\0';
    for (const double value : camera_pose(pose.T_map_body)) {
      if (separator != '\0') text += separator;
      append_double(text, value + 0.0);  // turns -0 into 0
      separator = ' ';
    }
    text += '\n';
  }
  return text;
}

std::string kitti_times(const Estimated& estimated) {
  std::string text;
  for (const EstimatedPose& pose : estimated.poses) {
    append_seconds(text, Stamp{pose.stamp - estimated.poses.front().stamp});
    text += '\n';
  }
  return text;
}

std::string path_geojson(const Estimated& estimated, const std::optional<MapOrigin>& origin) {
  const GeoPlacement placement(origin);
  GeoJson features = GeoJson::array();
  features.push_back(path_feature(estimated, placement, origin.has_value()));
  for (const LandmarkEstimate& landmark : estimated.landmarks) features.push_back(landmark_point(landmark, placement));
  return geojson_collection(origin, std::move(features)).dump(1) + '\n';
}

}  // namespace azimuth
