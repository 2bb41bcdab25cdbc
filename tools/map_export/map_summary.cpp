#include "tools/map_export/map_summary.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tools/map_export/own_covariance.hpp"

namespace azimuth {
namespace {

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

}  // namespace

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
