#include "tools/export/geojson_export.hpp"

#include <cmath>
#include <utility>

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

}  // namespace

std::string path_geojson(const Estimated& estimated, const std::optional<MapOrigin>& origin) {
  const GeoPlacement placement(origin);
  GeoJson features = GeoJson::array();
  features.push_back(path_feature(estimated, placement, origin.has_value()));
  for (const LandmarkEstimate& landmark : estimated.landmarks) features.push_back(landmark_point(landmark, placement));
  return geojson_collection(origin, std::move(features)).dump(1) + '\n';
}

}  // namespace azimuth
