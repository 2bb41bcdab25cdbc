// The cost of a hypothesis (mathematics VI.20).

#include <algorithm>
#include <cmath>

#include "slam/hypotheses/hypothesis.hpp"

namespace azimuth {
namespace {

// Number of images after a landmark's last bearing in which it can count as missed. After that the landmark counts as
// gone.
constexpr PoseId kMissedAfterLast = 12;

}  // namespace

double Hypothesis::energy() const {
  const double alone = settings_.costs.unassigned;
  double energy = settings_.costs.landmark * static_cast<double>(landmarks_.size());
  for (PoseId id = 1; id < graph().poses(); ++id) energy += 0.5 * graph().odometry_chi2(id);
  for (BearingId id = 0; id < graph().bearings(); ++id)
    energy += is_unassigned(id) ? alone : std::min(0.5 * graph().chi2_of(id), alone);
  return energy + member_.missed_scale * settings_.costs.missed * missed();
}

int Hypothesis::missed() const {
  struct Stand {
    Eigen::Vector2d p, forwards;
  };
  std::vector<Stand> path;
  path.reserve(static_cast<std::size_t>(graph().poses()));
  for (PoseId id = 0; id < graph().poses(); ++id)
    path.push_back({graph().camera_at(id).T_map_body.position(), graph().smoothed_pose(id).forwards});
  const Scene& scene = settings_.scene;
  const double range2_m2 = scene.surely_seen_within_m() * scene.surely_seen_within_m();
  const bool all_round = scene.sees_all_round();
  const double edge = std::cos(0.5 * scene.field_of_view_rad);

  int missed = 0;
  std::vector<PoseId> seen_from;
  for (const LandmarkId id : landmarks_) {
    const SmoothedLandmark& landmark = graph().landmark(id);
    if (!landmark.is_point() || graph().bearings_of(id).empty()) continue;
    const Eigen::Vector2d p = landmark.p_map();
    const auto should_be_seen = [&](PoseId from) {
      const Stand& stand = path[static_cast<std::size_t>(from)];
      const Eigen::Vector2d away = p - stand.p;
      const double distance2_m2 = away.squaredNorm();
      return distance2_m2 <= range2_m2 && (all_round || stand.forwards.dot(away) >= edge * std::sqrt(distance2_m2));
    };
    seen_from.clear();
    for (const BearingId bearing : graph().bearings_of(id)) seen_from.push_back(graph().bearing(bearing).pose);
    std::sort(seen_from.begin(), seen_from.end());
    seen_from.erase(std::unique(seen_from.begin(), seen_from.end()), seen_from.end());
    const PoseId end = std::min(graph().poses(), seen_from.back() + 1 + kMissedAfterLast);
    for (PoseId from = seen_from.front(); from < end; ++from) missed += should_be_seen(from) ? 1 : 0;
    missed -= static_cast<int>(std::count_if(seen_from.begin(), seen_from.end(), should_be_seen));
  }
  return missed;
}

}  // namespace azimuth
