#include "tools/replay/replay_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/replay/summary.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMostKinds = 64;  // limit of the kinds in the legend

/// The true path in pieces, split at gaps in the truth longer than kMaxTruthGap_s.
std::vector<PlotLine> truth_lines(const Run& run, const Pose2& T_map_world) {
  std::vector<PlotLine> pieces;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const bool gap = i > 0 && run.truth[i].stamp - run.truth[i - 1].stamp > duration_from_seconds(kMaxTruthGap_s);
    if (i == 0 || gap) pieces.emplace_back();
    pieces.back().push_back(T_map_world * run.truth[i].T_world_body.position());
  }
  return pieces;
}

/// About thirty poses along the path for covariance ellipses. More ellipses would hide the path.
std::vector<UncertainPoint> some_poses(const std::vector<EstimateRecord>& estimates) {
  constexpr std::size_t kPoses = 30;
  const std::size_t stride = std::max<std::size_t>(1, estimates.size() / kPoses);
  std::vector<UncertainPoint> poses;
  for (std::size_t i = stride - 1; i < estimates.size(); i += stride)
    poses.push_back({estimates[i].T_map_body.position(), estimates[i].covariance.topLeftCorner<2, 2>()});
  return poses;
}

/// Caption on the map error. It uses the pairing by identity if possible, since the pairing by position does not detect
/// confused landmarks.
std::string map_quality(const Report& report) {
  const bool by_name = report.named_map.named > 0;
  const std::size_t mapped = by_name ? report.named_map.named : report.map.matched;
  const ErrorStatistics& errors = by_name ? report.named_map.position_m : report.map.position_m;
  if (mapped == 0) return "";
  return fmt::format("; {} of {} true landmarks mapped, RMSE {:.3f} m", mapped, report.map.true_landmarks, errors.rmse);
}

std::string subtitle(const Report& report) {
  const std::string map = landmark_counts(report);
  if (report.position_m.count == 0) return fmt::format("{} estimates, {}, no truth to compare with", report.steps, map);
  return fmt::format("position RMSE {:.3f} m, odometry alone {:.2f} m; {}{}", report.position_m.rmse,
                     report.odometry_m.rmse, map, map_quality(report));
}

/// The estimated path in pieces, by whether the robot was lost. The segment that leads to the first lost pose belongs
/// to the lost piece. The jump at relocalisation is not drawn.
std::vector<PathPiece> estimated_path(const ReplayResult& result) {
  std::vector<PathPiece> pieces;
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const bool lost = i < result.healths.size() && result.healths[i].health == Health::lost;
    if (pieces.empty() || pieces.back().lost != lost) {
      PathPiece next{{}, lost};
      if (lost && !pieces.empty()) next.line.push_back(pieces.back().line.back());
      pieces.push_back(std::move(next));
    }
    pieces.back().line.push_back(result.estimates[i].T_map_body.position());
  }
  return pieces;
}

/// The middle of the class's hue range; nothing if the class accepts all hues.
std::optional<double> hue_deg(const ColourClass& colours) {
  const double span_deg = colours.hue_to_deg - colours.hue_from_deg;
  if (span_deg >= 360.0) return std::nullopt;
  return std::fmod(colours.hue_from_deg + (span_deg < 0.0 ? span_deg + 360.0 : span_deg) / 2, 360.0);
}

/// Landmarks by id as a saved map would contain them.
using Settled = std::map<std::int64_t, const MapLandmark*>;

Settled settled(const ReplayResult& result) {
  Settled landmarks;
  if (result.map)
    for (const MapLandmark& landmark : result.map->landmarks) landmarks[landmark.id] = &landmark;
  return landmarks;
}

std::vector<PlottedKind> kinds_of(const Settled& landmarks, std::span<const ColourClass> classes) {
  std::vector<PlottedKind> kinds;
  for (const ColourClass& colours : classes) kinds.push_back({colours.name, hue_deg(colours)});
  for (const auto& [id, landmark] : landmarks)
    while (std::cmp_greater_equal(landmark->kind, kinds.size()) && kinds.size() < kMostKinds)
      kinds.push_back({fmt::format("kind {}", kinds.size()), std::nullopt});
  return kinds;
}

/// The sensor's identity of the landmark, otherwise its id, which the map file also uses.
std::string name_of(const LandmarkEstimate& landmark) {
  return fmt::format("{}", landmark.identity == kUnknownIdentity ? landmark.id : landmark.identity);
}

void add_landmarks(const ReplayResult& result, std::span<const ColourClass> classes, MapPicture& picture) {
  const Settled known = settled(result);
  picture.kinds = kinds_of(known, classes);
  for (const LandmarkEstimate& landmark : result.last.landmarks) {
    const auto found = known.find(landmark.id);
    picture.landmarks.push_back(
        {.point = {landmark.p_map_landmark_m, landmark.covariance_m2},
         .name = name_of(landmark),
         .kind = found == known.end() ? kAnyKind : found->second->kind,
         .is_known = !result.map || found != known.end(),
         .id = landmark.identity == kUnknownIdentity ? std::optional(landmark.id) : std::nullopt});
  }
}

void add_truth(const Run& run, const Report& report, MapPicture& picture) {
  if (!report.T_world_map) return;
  const Pose2 T_map_world = inverse(*report.T_world_map);
  picture.truth = truth_lines(run, T_map_world);
  for (const TrueLandmark& landmark : run.landmarks)
    picture.true_landmarks.push_back(T_map_world * Eigen::Vector2d{landmark.x_m, landmark.y_m});
  if (report.natural_features) picture.true_landmark_words = "true landmark (features are of other things)";
}

}  // namespace

MapPicture replay_picture(const Run& run, const ReplayResult& result, const Report& report,
                          std::span<const ColourClass> classes) {
  MapPicture picture;
  picture.title = fmt::format("{}: {}", report.run, report.estimator);
  picture.subtitle = subtitle(report);
  if (report.natural_features) picture.landmark_word = "feature";
  picture.estimate = estimated_path(result);
  if (!result.estimates.empty()) {
    const EstimateRecord& first = result.estimates.front();
    const Pose2 T_map_odom = first.T_map_body * inverse(first.T_odom_body);
    for (const EstimateRecord& estimate : result.estimates)
      picture.odometry.push_back(T_map_odom * estimate.T_odom_body.position());
    picture.T_map_body = result.estimates.back().T_map_body;
  }
  for (const PastPose& past : result.past) picture.smoothed.push_back(past.T_map_body.position());
  picture.poses = some_poses(result.estimates);
  add_landmarks(result, report.front_end == "colour" ? classes : std::span<const ColourClass>(), picture);
  add_truth(run, report, picture);
  return picture;
}

}  // namespace azimuth
