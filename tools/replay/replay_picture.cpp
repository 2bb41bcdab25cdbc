#include "tools/replay/replay_picture.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace azimuth {
namespace {

/// True path in pieces, broken where truth is missing for longer than the report bridges.
std::vector<PlotLine> truth_lines(const Run& run, const Pose2& T_map_world) {
  std::vector<PlotLine> pieces;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const bool gap = i > 0 && run.truth[i].stamp - run.truth[i - 1].stamp > duration_from_seconds(kMaxTruthGap_s);
    if (i == 0 || gap) pieces.emplace_back();
    pieces.back().push_back(T_map_world * run.truth[i].T_world_body.position());
  }
  return pieces;
}

/// About thirty poses along the way, for their ellipses: more would hide the path.
std::vector<UncertainPoint> some_poses(const std::vector<EstimateRecord>& estimates) {
  constexpr std::size_t kPoses = 30;
  const std::size_t stride = std::max<std::size_t>(1, estimates.size() / kPoses);
  std::vector<UncertainPoint> poses;
  for (std::size_t i = stride - 1; i < estimates.size(); i += stride)
    poses.push_back({estimates[i].T_map_body.position(), estimates[i].covariance.topLeftCorner<2, 2>()});
  return poses;
}

std::string subtitle(const Report& report) {
  std::string text = fmt::format("{} estimates, {} landmarks", report.steps, report.map.landmarks);
  if (report.position_m.count == 0) return text + ", no truth to compare with";
  text = fmt::format("position RMSE {:.3f} m, odometry alone {:.2f} m", report.position_m.rmse, report.odometry_m.rmse);
  // Names judge more strictly than nearness: a picture must not praise a map that has its landmarks mixed up.
  const bool by_name = report.named_map.named > 0;
  const std::size_t mapped = by_name ? report.named_map.named : report.map.matched;
  const ErrorStatistics& errors = by_name ? report.named_map.position_m : report.map.position_m;
  if (mapped > 0)
    text += fmt::format("; {} of {} landmarks mapped, RMSE {:.3f} m", mapped, report.map.true_landmarks, errors.rmse);
  return text;
}

}  // namespace

MapPicture replay_picture(const Run& run, const ReplayResult& result, const Report& report) {
  MapPicture picture;
  picture.title = fmt::format("{}: {}", report.run, report.estimator);
  picture.subtitle = subtitle(report);
  for (const EstimateRecord& estimate : result.estimates) picture.estimate.push_back(estimate.T_map_body.position());
  if (!result.estimates.empty()) {
    const EstimateRecord& first = result.estimates.front();
    const Pose2 T_map_odom = first.T_map_body * inverse(first.T_odom_body);
    for (const EstimateRecord& estimate : result.estimates)
      picture.odometry.push_back(T_map_odom * estimate.T_odom_body.position());
    picture.T_map_body = result.estimates.back().T_map_body;
  }
  picture.poses = some_poses(result.estimates);
  for (const LandmarkEstimate& landmark : result.last.landmarks)
    picture.landmarks.push_back({landmark.p_map_landmark_m, landmark.covariance_m2});
  if (report.T_world_map) {
    const Pose2 T_map_world = inverse(*report.T_world_map);
    picture.truth = truth_lines(run, T_map_world);
    for (const TrueLandmark& landmark : run.landmarks)
      picture.true_landmarks.push_back(T_map_world * Eigen::Vector2d{landmark.x_m, landmark.y_m});
  }
  return picture;
}

}  // namespace azimuth
