#include "tools/drive_fit/known_points.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "slam/geometry/index.hpp"
#include "tools/evaluate/pose_error.hpp"

namespace azimuth {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t kLeastPoints = 4, kParts = 10;
// The wrong hand must increase the mean square residual by at least this factor. Such an increase is not due to chance,
// however large the errors of the points are.
constexpr double kClearlyWorse = 9.0;

/// Fit to all points except those of one part.
struct Fit {
  double scale = 1.0;
  double residual = 0.0, mirrored_residual = 0.0;  // sums of squares
  bool possible = false;
};

Fit fit(std::span<const KnownPoint> points, std::size_t part, std::size_t parts) {
  Complex mean_found, mean_world;
  double count = 0.0;
  const auto is_left_out = [&](std::size_t i) { return i * parts / points.size() == part; };
  const auto complex = [](const Eigen::Vector2d& p) { return Complex(p.x(), p.y()); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_left_out(i)) continue;
    mean_found += complex(points[i].found);
    mean_world += complex(points[i].p_world);
    ++count;
  }
  if (count < 2.0) return {};
  mean_found /= count;
  mean_world /= count;
  Complex same, mirror;
  double found2 = 0.0, world2 = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_left_out(i)) continue;
    const Complex found = complex(points[i].found) - mean_found, world = complex(points[i].p_world) - mean_world;
    same += std::conj(found) * world;
    mirror += found * world;
    found2 += std::norm(found);
    world2 += std::norm(world);
  }
  if (!(found2 > 1e-6) || !(world2 > 1e-6)) return {};
  const double best = std::max(std::abs(same), std::abs(mirror));
  return {best / found2, world2 - std::norm(same) / found2, world2 - std::norm(mirror) / found2, true};
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::map<Identity, LandmarkId> named_landmarks(const DriveGraph& graph) {
  std::map<Identity, LandmarkId> landmarks;
  for (const DriveGraph::Place& place : graph.places)
    for (const DriveGraph::Seen& seen : place.seen) landmarks[seen.bearing.identity] = seen.landmark;
  return landmarks;
}

}  // namespace

std::vector<KnownPoint> points_on_path(const DriveSolution& solution, std::span<const TruthPose> truth) {
  const Eigen::Vector2d mount_m = mount_of(solution.guess.rig);
  const Pose2 T_camera_robot{-mount_m.x(), -mount_m.y(), 0.0};
  const auto robot_at = [&](const Pose2& T_map_camera) { return T_map_camera * T_camera_robot; };
  std::vector<StampedPose> found, known;
  for (std::size_t i = 0; i < solution.graph.places.size(); ++i)
    found.push_back({solution.guess.jump.without(solution.graph.places[i].stamp),
                     robot_at(solution.graph.values.poses[i].T_map_body)});
  for (const TruthPose& pose : truth) known.push_back({pose.stamp, pose.T_world_body});
  std::vector<KnownPoint> points;
  for (const PosePair& pair : pair_with_truth(found, known))
    points.push_back({pair.estimated.position(), pair.T_world_body.position()});
  return points;
}

std::vector<KnownPoint> points_of_map(const DriveSolution& solution, std::span<const TrueLandmark> landmarks) {
  const auto named = named_landmarks(solution.graph);
  std::vector<KnownPoint> points;
  for (const TrueLandmark& landmark : landmarks) {
    const auto found = named.find(landmark.identity);
    if (landmark.identity == kUnknownIdentity || found == named.end()) continue;
    const SmoothedLandmark& state = solution.graph.values.landmarks[as_size(found->second)];
    if (state.is_point()) points.push_back({state.p_map(), {landmark.x_m, landmark.y_m}});
  }
  return points;
}

std::optional<Likeness> likeness(std::span<const KnownPoint> points) {
  if (points.size() < kLeastPoints) return std::nullopt;
  const Fit all = fit(points, kNone, 1);
  if (!all.possible) return std::nullopt;
  const std::size_t parts = std::min(kParts, points.size());
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    const Fit rest = fit(points, part, parts);
    if (!rest.possible) continue;
    sum += rest.scale;
    squares += rest.scale * rest.scale;
    ++count;
  }
  const double variance = std::max(0.0, squares - sum * sum / count) * (count - 1.0) / count;
  const auto [less, more] = std::minmax(all.residual, all.mirrored_residual);
  return Likeness{.lengths = {all.scale, std::sqrt(variance)},
                  .mirrored = all.mirrored_residual<all.residual, .hand_told = more> kClearlyWorse * less};
}

std::optional<LengthScale> scale_between(const Drive& drive, const DriveSolution& solution,
                                         const HindsightSettings& settings, Identity from, Identity to,
                                         double distance_m) {
  const auto named = named_landmarks(solution.graph);
  const auto a = named.find(from), b = named.find(to);
  if (a == named.end() || b == named.end() || a->second == b->second) return std::nullopt;
  const Smoother smoother = smoother_of(drive, solution.graph, solution.guess, {}, settings);
  const BearingGraph& graph = smoother.graph();
  if (!graph.landmark(a->second).is_point() || !graph.landmark(b->second).is_point()) return std::nullopt;
  const Eigen::Vector2d between = graph.landmark(b->second).p_map() - graph.landmark(a->second).p_map();
  const double found_m = between.norm();
  if (!(found_m > 0.0)) return std::nullopt;
  const std::array<Smoother::Unknown, 2> both{Smoother::LandmarkOf{a->second}, Smoother::LandmarkOf{b->second}};
  const Eigen::RowVector2d along = between.transpose() / found_m;
  Eigen::RowVector4d J;
  J << -along * graph.landmark(a->second).p_by_chart(), along * graph.landmark(b->second).p_by_chart();
  const double sigma_m = std::sqrt(std::max(0.0, (J * smoother.covariance(both) * J.transpose()).value()));
  const double scale = distance_m / found_m;
  return LengthScale{scale, scale * sigma_m / found_m};
}

}  // namespace azimuth
