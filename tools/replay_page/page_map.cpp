#include "tools/replay_page/page_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/evaluate/statistics.hpp"
#include "tools/page/thinning.hpp"
#include "tools/plot/landmark_style.hpp"

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

using Json = nlohmann::ordered_json;

constexpr double kPointUnit_m = 1e-3;
constexpr std::size_t kMostPathPoints = 6000;

/// Names in the order of the enumeration Marker.
constexpr std::array<std::string_view, 6> kMarkers{"disc", "square", "triangle", "diamond", "pentagon", "wedge"};

Json point(const Eigen::Vector2d& p_m) {
  return {page_number(p_m.x(), kPointUnit_m), page_number(p_m.y(), kPointUnit_m)};
}

std::string hex(const Colour& colour) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

Json style(const LandmarkStyle& style, std::string_view name) {
  return {
      {"name", name}, {"colour", hex(style.colour)}, {"marker", kMarkers.at(static_cast<std::size_t>(style.marker))}};
}

/// The styles of the kinds. The first one is for landmarks of unknown kind.
Json kinds(const MapPicture& picture) {
  Json json = Json::array();
  json.push_back(style(plain_landmark_style(), ""));
  for (std::size_t i = 0; i < picture.kinds.size(); ++i)
    json.push_back(style(landmark_style(picture.kinds[i], i), picture.kinds[i].name));
  return json;
}

/// Names of landmarks on a page. If no landmark has an identity, landmarks are numbered from 1 in the order of their
/// ids, since ids have gaps from deleted landmarks.
class PageNames {
 public:
  explicit PageNames(const MapPicture& picture) {
    for (const PlottedLandmark& landmark : picture.landmarks)
      if (landmark.id) ids_.push_back(*landmark.id);
    if (ids_.size() < picture.landmarks.size()) ids_.clear();
    std::ranges::sort(ids_);
  }

  std::string of(const PlottedLandmark& landmark) const {
    if (ids_.empty()) return landmark.name;
    return std::to_string(std::ranges::lower_bound(ids_, *landmark.id) - ids_.begin() + 1);
  }

 private:
  std::vector<std::int64_t> ids_;
};

Json landmark(const PlottedLandmark& landmark, const PageNames& names, std::size_t kinds) {
  const Eigen::Matrix2d& P = landmark.point.covariance_m2;
  const bool of_a_kind = landmark.kind >= 0 && static_cast<std::size_t>(landmark.kind) < kinds;
  return {{"name", names.of(landmark)},
          {"id", landmark.id ? Json(*landmark.id) : Json(nullptr)},
          {"at", point(landmark.point.p_map_m)},
          {"covariance", {page_number(P(0, 0)), page_number(P(0, 1)), page_number(P(1, 1))}},
          {"kind", of_a_kind ? landmark.kind + 1 : 0},
          {"settled", landmark.is_known}};
}

Json path(const PlotLine& line) {
  std::vector<double> x, y;
  for (const Eigen::Vector2d& p_m : line) {
    x.push_back(p_m.x());
    y.push_back(p_m.y());
  }
  const std::array<std::span<const double>, 2> axes{x, y};
  Json json = Json::array();
  for (const std::size_t i : thinned(line.size(), axes, kMostPathPoints)) json.push_back(point(line[i]));
  return json;
}

}  // namespace

Json page_number(double value, double unit) {
  if (!std::isfinite(value)) return nullptr;
  if (unit == 0.0) return value == 0.0 ? Json(0) : Json(std::stod(fmt::format("{:.5g}", value)));
  const double rounded = std::round(value / unit);
  if (unit == 1.0) return static_cast<std::int64_t>(rounded);
  return rounded / std::round(1.0 / unit) + 0.0;  // turns -0 into 0
}

Json page_map(const MapPicture& picture) {
  std::vector<const PlottedLandmark*> best;
  for (const PlottedLandmark& landmark : picture.landmarks) best.push_back(&landmark);
  if (best.size() > kMostPageLandmarks) {
    const auto spread = [](const PlottedLandmark* landmark) { return semi_major_m(landmark->point); };
    std::ranges::nth_element(best, best.begin() + kMostPageLandmarks, {}, spread);
    best.resize(kMostPageLandmarks);
  }
  Json json{{"word", picture.landmark_word},      {"true_words", picture.true_landmark_words},
            {"all", picture.landmarks.size()},    {"kinds", kinds(picture)},
            {"landmarks", Json::array()},         {"true_landmarks", Json::array()},
            {"hindsight", path(picture.smoothed)}};
  const PageNames names(picture);
  for (const PlottedLandmark* one : best) json["landmarks"].push_back(landmark(*one, names, picture.kinds.size()));
  for (const Eigen::Vector2d& p_m : picture.true_landmarks) json["true_landmarks"].push_back(point(p_m));
  return json;
}

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
