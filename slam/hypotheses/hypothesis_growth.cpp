// New landmarks, found from bearings of several images together (mathematics VI.20).

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "slam/hypotheses/hypothesis.hpp"

namespace azimuth {
namespace {

constexpr PoseId kSecondWithinImages = 4;
constexpr std::size_t kFirstTracks = 3;
constexpr double kFirstMayRaise = 2.0;
constexpr double kGateChi2 = 9.0;
constexpr double kNearest_m = 0.3;
constexpr double kAnyRatio = -std::numeric_limits<double>::infinity();

/// Geometric mean of the expected density and the density of all bearings. It is unknown whether a crowd of bearings
/// belongs to landmarks or is clutter.
double between(double expected_per_rad, double all_per_rad) {
  return std::sqrt(expected_per_rad * std::max(expected_per_rad, all_per_rad));
}

}  // namespace

/// Tries sets of new landmarks. Landmarks are added to a set one after the other, each decided with all bearings of the
/// window, because landmarks that would be rejected alone may be right together.
///
/// Where many landmarks are seen at once and the error of odometry's turns exceeds the angle between neighbouring
/// bearings, no single track beats chance; a track becomes likely only at the pose that other tracks suggest. If a
/// whole window has started no map, the most likely tracks are tried nevertheless, and the bearings that they explain
/// count for less.
void Hypothesis::grow(const WindowBelief& belief, PoseId oldest_anchor) {
  std::vector<Track> first_tracks = find_tracks(belief, oldest_anchor, member_.min_log_ratio);
  HypothesisCosts costs = settings_.costs;
  if (first_tracks.empty() && landmarks_.empty() && window_start() > 0) {
    first_tracks = find_tracks(belief, oldest_anchor, kAnyRatio);
    Scene crowd = settings_.scene;
    crowd.clutter_per_rad = between(crowd.clutter_per_rad, bearings_per_rad());
    crowd.new_per_rad = between(crowd.new_per_rad, bearings_per_rad());
    costs = hypothesis_costs(crowd, settings_.smoother);
  }
  if (first_tracks.empty()) return;
  const auto cost_of = [&](const Hypothesis& hypothesis) {
    return hypothesis.energy() +
           (settings_.costs.unassigned - costs.unassigned) * static_cast<double>(hypothesis.explained()) -
           (settings_.costs.landmark - costs.landmark) * static_cast<double>(hypothesis.landmarks_.size());
  };
  const double before = cost_of(*this);
  struct Set {
    Hypothesis hypothesis;
    WindowBelief path;
    double cost;
  };
  // A new landmark ties the window's poses to each other and so makes further tracks clearer.
  const auto initialised = [&](const Hypothesis& from, const Track& track) {
    Hypothesis next = from;
    next.initialise(track);
    next.smoother_.optimise();
    next.reassociate(belief, window_start());
    WindowBelief path(next.smoother_, window_start(), {}, settings_.smoother.min_distance_m);
    const double cost = cost_of(next);
    return Set{std::move(next), std::move(path), cost};
  };
  std::optional<Hypothesis> best;
  double best_cost = before - member_.min_fall;
  for (std::size_t i = 0; i < std::min(first_tracks.size(), kFirstTracks); ++i) {
    Set set = initialised(*this, first_tracks[i]);
    if (set.cost > before + kFirstMayRaise) continue;
    for (;;) {
      const std::vector<Track> tracks = set.hypothesis.find_tracks(set.path, oldest_anchor, member_.min_log_ratio);
      if (tracks.empty()) break;
      Set more = initialised(set.hypothesis, tracks.front());
      if (more.cost > set.cost - member_.step_fall) break;
      set = std::move(more);
    }
    if (set.cost >= best_cost) continue;
    best_cost = set.cost;
    best = std::move(set.hypothesis);
  }
  if (best) *this = std::move(*best);
}

void Hypothesis::initialise(const Track& track) {
  // The oldest bearing defines the chart, since the landmark was seen from there first.
  const LandmarkId id = smoother_.add_landmark(track.bearings.back());
  for (const BearingId bearing : track.bearings) smoother_.assign(bearing, id);
  landmarks_.push_back(id);
  const Eigen::Matrix2d by_chart = track.landmark.p_by_chart();
  grown_.push_back({id, by_chart * track.covariance * by_chart.transpose()});
}

double Hypothesis::bearings_per_rad() const {
  return static_cast<double>(graph().bearings()) / images() / settings_.scene.field_of_view_rad;
}

BearingId Hypothesis::explained(PoseId since) const {
  BearingId count = 0;
  for (BearingId id = first_bearing(since); id < graph().bearings(); ++id) count += is_unassigned(id) ? 0 : 1;
  return count;
}

/// Returns the tracks, most likely first.
std::vector<Hypothesis::Track> Hypothesis::find_tracks(const WindowBelief& belief, PoseId oldest_anchor,
                                                       double min_log_ratio) const {
  std::vector<Track> found;
  for (PoseId anchor = images() - 1; anchor >= oldest_anchor; --anchor)
    for (BearingId bearing = first_bearing(anchor); bearing < first_bearing(anchor + 1); ++bearing)
      if (is_unassigned(bearing)) find_tracks_from(belief, anchor, bearing, min_log_ratio, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Track& a, const Track& b) { return a.log_ratio > b.log_ratio; });
  return found;
}

/// Appends the tracks whose newest bearing is `bearing`, unless they were found already.
void Hypothesis::find_tracks_from(const WindowBelief& belief, PoseId anchor, BearingId bearing, double min_log_ratio,
                                  std::vector<Track>& found) const {
  const auto is_found = [&found](BearingId one, BearingId other) {
    return std::any_of(found.begin(), found.end(), [&](const Track& track) {
      return std::find(track.bearings.begin(), track.bearings.end(), one) != track.bearings.end() &&
             std::find(track.bearings.begin(), track.bearings.end(), other) != track.bearings.end();
    });
  };
  if (is_found(bearing, bearing) && anchor + 1 < images()) return;
  const SmootherSettings& smoother = settings_.smoother;
  const double sigma_rad = graph().bearing(bearing).sigma_rad, sigma_per_m = smoother.inverse_depth_sigma_per_m;
  const Pose2 T = graph().camera_at(anchor).T_map_body;
  Track ray;
  ray.bearings = {bearing};
  ray.kind = kinds_[bearing];
  ray.landmark = {T.position(), T.heading_rad + graph().bearing(bearing).azimuth_rad,
                  smoother.inverse_depth_mean_per_m};
  ray.covariance.diagonal() << sigma_rad * sigma_rad + belief.relative_to_newest(anchor)(2, 2),
      sigma_per_m * sigma_per_m;
  for (PoseId second = anchor - 1; second >= std::max(belief.first(), anchor - kSecondWithinImages); --second)
    for (BearingId b = first_bearing(second); b < first_bearing(second + 1); ++b) {
      if (!is_unassigned(b) || !may_be_of(b, ray.kind) || is_found(bearing, b)) continue;
      Track track = ray;
      if (update_track(track, second, b, belief, track.log_ratio) && walk(belief, track, anchor, second) &&
          track.log_ratio > min_log_ratio)
        found.push_back(std::move(track));
    }
}

/// Adds a bearing to the track. Returns false and leaves the track unchanged when the bearing is outside its gate.
bool Hypothesis::update_track(Track& track, PoseId pose_id, BearingId bearing, const WindowBelief& belief,
                              double& log_density) const {
  const SmoothedPose pose = graph().camera_at(pose_id);
  const BearingMeasurement& measured = graph().bearing(bearing);
  SeenAzimuth seen;
  if (!see(pose, track.landmark, settings_.smoother.min_distance_m, seen)) return false;
  const double R =
      measured.sigma_rad * measured.sigma_rad + seen.by_pose.dot(belief.relative_to_newest(pose_id) * seen.by_pose);
  const Eigen::Vector2d PH = track.covariance * seen.by_landmark;
  const double S = R + seen.by_landmark.dot(PH);
  const double off = wrap(measured.azimuth_rad - seen.azimuth_rad);
  if (!(off * off < kGateChi2 * S)) return false;
  log_density = log_normal_density(off, S);
  track.landmark = track.landmark.moved(PH * (off / S));
  track.covariance -= PH * PH.transpose() / S;
  track.bearings.push_back(bearing);
  if (track.kind == kAnyKind) track.kind = kinds_[bearing];
  return true;
}

/// Follows the track backwards through the window. Returns false when it is not worth a landmark.
bool Hypothesis::walk(const WindowBelief& belief, Track& track, PoseId anchor, PoseId second) const {
  const double log_hit = std::log(settings_.scene.detection_probability / bearings_per_rad());
  const double log_miss = std::log1p(-settings_.scene.detection_probability);
  const double asked_m = settings_.scene.asked_within_m();
  const double seen_m = settings_.scene.surely_seen_within_m();
  track.log_ratio += log_hit;
  for (PoseId id = images() - 1; id >= belief.first(); --id) {
    if (id == anchor) continue;
    const double rho = track.landmark.inverse_distance_per_m;
    if (!(rho > 1.0 / asked_m && rho < 1.0 / kNearest_m)) return false;
    const auto images_left = static_cast<std::size_t>(id - belief.first() + 1);
    if (track.bearings.size() + images_left < static_cast<std::size_t>(member_.min_hits)) return false;
    if (id == second) continue;
    const SmoothedPose pose = graph().camera_at(id);
    const double distance_m = (track.landmark.p_map() - pose.T_map_body.position()).norm();
    SeenAzimuth seen;
    if (distance_m > asked_m || !see(pose, track.landmark, settings_.smoother.min_distance_m, seen)) continue;
    if (!settings_.scene.in_view(seen.azimuth_rad)) continue;
    BearingId nearest = -1;
    double nearest_off = std::numeric_limits<double>::infinity();
    for (BearingId b = first_bearing(id); b < first_bearing(id + 1); ++b) {
      if (!is_unassigned(b) || !may_be_of(b, track.kind)) continue;
      const double off = std::abs(wrap(graph().bearing(b).azimuth_rad - seen.azimuth_rad));
      if (off < nearest_off) {
        nearest_off = off;
        nearest = b;
      }
    }
    double log_density = 0.0;
    if (nearest >= 0 && update_track(track, id, nearest, belief, log_density))
      track.log_ratio += log_hit + log_density;
    else if (distance_m < seen_m)
      track.log_ratio += log_miss;
  }
  std::sort(track.bearings.begin(), track.bearings.end(), std::greater<>());
  return track.bearings.size() >= static_cast<std::size_t>(member_.min_hits) && track.landmark.is_point();
}

}  // namespace azimuth
