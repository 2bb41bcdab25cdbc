#include "tools/map_export/map_geojson.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "tools/map_export/own_covariance.hpp"

namespace azimuth {
namespace {

GeoJson landmark_feature(const MapLandmark& landmark, const Eigen::Matrix3d& P, const GeoPlacement& placement) {
  GeoJson properties = {{"what", "landmark"}, {"landmark_id", landmark.id}, {"sightings", landmark.sightings}};
  if (landmark.identity != kUnknownIdentity) properties["identity"] = landmark.identity;
  if (landmark.kind != kAnyKind) properties["kind"] = landmark.kind;
  const auto size = static_cast<Eigen::Index>(landmark.size());
  properties["covariance_m2"] = covariance_json(P.topLeftCorner(size, size));
  properties["ellipse"] = ellipse_json(P.topLeftCorner<2, 2>());
  return {{"type", "Feature"},
          {"id", std::to_string(landmark.id)},
          {"geometry", placement.point(landmark.p_map_landmark_m, landmark.z_map_landmark_m)},
          {"properties", properties}};
}

GeoJson robot_feature(const MapSnapshot& map, const GeoPlacement& placement) {
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

}  // namespace

std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin) {
  const GeoPlacement placement(origin);
  GeoJson features = GeoJson::array();
  for_each_landmark(map, [&](const MapLandmark& landmark, const Eigen::Matrix3d& P) {
    features.push_back(landmark_feature(landmark, P, placement));
  });
  features.push_back(robot_feature(map, placement));
  return geojson_collection(origin, std::move(features)).dump(1) + '\n';
}

}  // namespace azimuth
