#include "tools/map_export/map_texts.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// Calls `use(landmark, covariance)` for each landmark, with the covariance of its coordinates [m^2]. The entries of
/// the height are zero for a landmark without a height.
template <class Use>
void for_each_landmark(const MapSnapshot& map, const Use& use) {
  std::size_t first = map.first_landmark_entry();
  for (const MapLandmark& landmark : map.landmarks) {
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
    for (std::size_t r = 0; r < landmark.size(); ++r)
      for (std::size_t c = 0; c < landmark.size(); ++c)
        P(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = map.covariance(first + r, first + c);
    use(landmark, P);
    first += landmark.size();
  }
}

using Json = nlohmann::ordered_json;

std::string names_text(MapNames names) {
  switch (names) {
    case MapNames::none:
      return "position";
    case MapNames::sensor:
      return "name";
    case MapNames::looks:
      return "looks";
  }
  return "?";
}

/// The larger standard deviation of each landmark's position in the plane, in ascending order.
std::vector<double> spreads_m(const MapSnapshot& map) {
  std::vector<double> spreads;
  for_each_landmark(map, [&spreads](const MapLandmark&, const Eigen::Matrix3d& P) {
    spreads.push_back(std::sqrt(std::max(P(0, 0), P(1, 1))));
  });
  std::ranges::sort(spreads);
  return spreads;
}

std::size_t with_height(const MapSnapshot& map) {
  return static_cast<std::size_t>(std::ranges::count_if(map.landmarks, &MapLandmark::has_height));
}

struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
};

Extent extent(const MapSnapshot& map) {
  Extent extent;
  if (map.landmarks.empty()) return extent;
  extent.low = extent.high = map.landmarks.front().p_map_landmark_m;
  for (const MapLandmark& landmark : map.landmarks) {
    extent.low = extent.low.cwiseMin(landmark.p_map_landmark_m);
    extent.high = extent.high.cwiseMax(landmark.p_map_landmark_m);
  }
  return extent;
}

double sigma(const MapSnapshot& map, std::size_t entry) { return std::sqrt(map.covariance(entry, entry)); }

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

std::string known(std::int64_t value) { return value < 0 ? "" : fmt::format("{}", value); }

}  // namespace

std::string map_csv(const MapSnapshot& map) {
  std::string csv =
      "landmark_id,x_m,y_m,z_m,kind,identity,sightings,var_x_m2,var_y_m2,var_z_m2,cov_xy_m2,cov_xz_m2,cov_yz_m2\n";
  for_each_landmark(map, [&csv](const MapLandmark& landmark, const Eigen::Matrix3d& P) {
    const bool high = landmark.has_height();
    const auto of_height = [high](double value) { return high ? fmt::format("{}", value) : std::string(); };
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", landmark.id, landmark.p_map_landmark_m.x(),
                       landmark.p_map_landmark_m.y(), of_height(landmark.z_map_landmark_m), known(landmark.kind),
                       known(landmark.identity), landmark.sightings, P(0, 0), P(1, 1), of_height(P(2, 2)), P(1, 0),
                       of_height(P(2, 0)), of_height(P(2, 1)));
  });
  return csv;
}

std::string map_geojson(const MapSnapshot& map, const std::optional<MapOrigin>& origin) {
  const GeoPlacement placement(origin);
  GeoJson features = GeoJson::array();
  for_each_landmark(map, [&](const MapLandmark& landmark, const Eigen::Matrix3d& P) {
    features.push_back(landmark_feature(landmark, P, placement));
  });
  features.push_back(robot_feature(map, placement));
  return geojson_collection(origin, std::move(features)).dump(1) + '\n';
}

std::string map_summary(const LoadedMap& loaded) {
  const MapSnapshot& map = loaded.map;
  const std::vector<double> spreads = spreads_m(map);
  const Extent box = extent(map);
  const Pose2& pose = map.T_map_body;
  std::string summary =
      fmt::format("map         {}, version {}, {} bytes\n", loaded.file.string(), kMapVersion, loaded.bytes.size());
  summary += fmt::format("saved       at {:.6f} s, robot at x {:.2f} y {:.2f} m, heading {:.1f} deg, +-{:.2f} m\n",
                         to_seconds(map.stamp), pose.x_m, pose.y_m, rad_to_degrees(pose.heading_rad),
                         std::hypot(sigma(map, 0), sigma(map, 1)));
  summary += fmt::format("landmarks   {} settled ones (a map keeps no others), {} with height, known by {}",
                         map.landmarks.size(), with_height(map), names_text(map.names));
  summary += map.views.empty() ? "\n" : fmt::format(" ({} views)\n", map.views.size());
  if (spreads.empty()) return summary;
  summary += fmt::format("extent      x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m\n", box.low.x(), box.high.x(),
                         box.low.y(), box.high.y());
  summary += fmt::format("certainty   standard deviation {:.3f} m median, {:.3f} m at most\n",
                         spreads[spreads.size() / 2], spreads.back());
  return summary;
}

std::string map_summary_json(const LoadedMap& loaded) {
  const MapSnapshot& map = loaded.map;
  const std::vector<double> spreads = spreads_m(map);
  const Extent box = extent(map);
  const Pose2& pose = map.T_map_body;
  Json json = {{"file", loaded.file.string()},
               {"version", kMapVersion},
               {"bytes", loaded.bytes.size()},
               {"utime", to_us(map.stamp)},
               {"pose", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}}},
               {"landmarks", map.landmarks.size()},
               {"with_height", with_height(map)},
               {"known_by", names_text(map.names)},
               {"views", map.views.size()}};
  if (!spreads.empty()) {
    json["extent_m"] = {{"x", {box.low.x(), box.high.x()}}, {"y", {box.low.y(), box.high.y()}}};
    json["sigma_m"] = {{"median", spreads[spreads.size() / 2]}, {"max", spreads.back()}};
  }
  return json.dump(1) + '\n';
}

}  // namespace azimuth
