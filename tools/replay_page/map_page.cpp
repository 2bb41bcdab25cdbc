#include "tools/replay_page/map_page.hpp"

#include <fmt/format.h>
#include <utility>

#include "tools/evaluate/chi2.hpp"
#include "tools/replay_page/page_map.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostMapKinds = 64;

bool has_name(const MapLandmark& landmark, MapNames names) {
  return names == MapNames::sensor && landmark.identity != kUnknownIdentity;
}

/// The sensor's identity of the landmark, otherwise its id.
std::string name_of(const MapLandmark& landmark, MapNames names) {
  return fmt::format("{}", has_name(landmark, names) ? landmark.identity : landmark.id);
}

MapPicture picture_of(const MapSnapshot& map) {
  MapPicture picture;
  std::size_t row = map.first_landmark_entry();
  for (const MapLandmark& landmark : map.landmarks) {
    Eigen::Matrix2d P;
    P << map.covariance(row, row), map.covariance(row + 1, row), map.covariance(row + 1, row),
        map.covariance(row + 1, row + 1);
    row += landmark.size();
    while (std::cmp_greater_equal(landmark.kind, picture.kinds.size()) && picture.kinds.size() < kMostMapKinds)
      picture.kinds.push_back({fmt::format("kind {}", picture.kinds.size()), std::nullopt});
    picture.landmarks.push_back({.point = {landmark.p_map_landmark_m, P},
                                 .name = name_of(landmark, map.names),
                                 .kind = landmark.kind,
                                 .id = has_name(landmark, map.names) ? std::nullopt : std::optional(landmark.id)});
  }
  picture.landmark_word = map.names == MapNames::looks ? "feature" : "landmark";
  picture.T_map_body = map.T_map_body;
  return picture;
}

}  // namespace

Json page_of_map(const MapSnapshot& map, const std::string& name) {
  Json json;
  json["name"] = name;
  json["estimator"] = "map file";
  for (const char* const text : {"front_end", "digest", "trouble", "unread"}) json[text] = "";
  json["steps"] = 0;
  json["starts_at_us"] = to_us(map.stamp);
  json["nees_bounds"] = {page_number(chi2_quantile(0.025, 3)), page_number(chi2_quantile(0.975, 3))};
  json["metrics"] = Json::array();
  for (const char* const column : {"step", "t", "x", "y", "heading", "xx", "xy", "yy", "odometry_x", "odometry_y",
                                   "odometry_heading", "two_sigma_x", "two_sigma_y", "two_sigma_heading"})
    json["series"][column] = Json::array();
  json["health"] = Json::array();
  json["map"] = page_map(picture_of(map));
  json["pictures"] = Json::array();
  return json;
}

}  // namespace azimuth
