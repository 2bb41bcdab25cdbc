// Hindsight: bearings of past images are associated anew (mathematics VI.20).

#include <algorithm>
#include <cmath>

#include "slam/hypotheses/clear_pairs.hpp"
#include "slam/hypotheses/hypothesis.hpp"

namespace azimuth {
namespace {

constexpr int kRounds = 2;
constexpr std::size_t kFewestBearings = 3;
// Minimum gain of an association over none.
constexpr double kBetterThanNothing = 0.3;
// Extra cost of a new pair in one of the newest images. There is little hindsight on these images yet, and a pair that
// was unclear when the image came is hardly clearer.
constexpr PoseId kImagesOfLittleHindsight = 3;
constexpr double kLittleHindsight = 1.5;
// Relative variance that landmarks add to a bearing before the window, where the exact variance is not computed.
constexpr double kPastVarianceShare = 0.1;

}  // namespace

void Hypothesis::reassociate(const WindowBelief& belief, PoseId from) {
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (PoseId image = from; image < images(); ++image) changed = reassociate_image(belief, image) || changed;
    if (!changed) return;
    remove_weak_landmarks();
    smoother_.optimise();
  }
}

/// Associates one image anew. Returns true when an association has changed.
bool Hypothesis::reassociate_image(const WindowBelief& belief, PoseId image) {
  const SmoothedPose pose = graph().camera_at(image);
  const BearingId first = first_bearing(image), end = first_bearing(image + 1);
  if (first == end) return false;
  const double max2_m2 = settings_.scene.asked_within_m() * settings_.scene.asked_within_m();
  const double dearest = settings_.costs.unassigned - kBetterThanNothing;
  // Where landmarks are merged, bearings must be free to move from one landmark to the other.
  const bool stands = !settings_.tracks.used && (member_.past_stands || image >= belief.first());
  const double stands_by = stands ? member_.rival_gap : 0.0;
  const bool is_new = !settings_.tracks.used && image >= images() - kImagesOfLittleHindsight;
  const double new_costs = is_new ? kLittleHindsight : 0.0;
  std::vector<CostlyPair> pairs;
  for (const LandmarkId id : landmarks_) {
    const SmoothedLandmark& landmark = graph().landmark(id);
    SeenAzimuth seen;
    if (landmark.is_point() ? (landmark.p_map() - pose.T_map_body.position()).squaredNorm() > max2_m2
                            : !settings_.tracks.used)
      continue;
    if (!see(pose, landmark, settings_.smoother.min_distance_m, seen)) continue;
    const double variance = prediction_variance(belief, image, id, seen);
    const Kind kind = kind_of(id);
    for (BearingId bearing = first; bearing < end; ++bearing) {
      if (!may_be_of(bearing, kind)) continue;
      const BearingMeasurement& measured = graph().bearing(bearing);
      const double off = wrap(measured.azimuth_rad - seen.azimuth_rad);
      const double R = measured.sigma_rad * measured.sigma_rad;
      const double S = variance < 0.0 ? (1.0 + kPastVarianceShare) * R : R + variance;
      const double by_distance = 0.5 * off * off / S;  // lower bound of the cost of a pair that does not stand yet
      if (by_distance >= dearest + member_.rival_gap) continue;
      const double by_standing = graph().landmark_of(bearing) == id ? -stands_by : new_costs;
      const double cost = by_distance + 0.5 * std::log(S / R) + by_standing;
      if (cost < dearest + member_.rival_gap) pairs.push_back({cost, bearing, id});
    }
  }
  const std::vector<LandmarkId> chosen = clear_pairs(pairs, first, static_cast<std::size_t>(end - first),
                                                     {settings_.costs.unassigned, dearest, member_.rival_gap});

  bool changed = false;
  for (BearingId bearing = first; bearing < end; ++bearing) {
    const LandmarkId landmark = chosen[static_cast<std::size_t>(bearing - first)];
    if (graph().landmark_of(bearing) == landmark) continue;
    smoother_.assign(bearing, landmark);
    changed = true;
  }
  return changed;
}

/// Variance of a predicted azimuth; negative when it is not known.
double Hypothesis::prediction_variance(const WindowBelief& belief, PoseId pose, LandmarkId landmark,
                                       const SeenAzimuth& seen) const {
  const double variance = belief.variance(pose, landmark);
  if (variance >= 0.0 || pose < belief.first()) return variance;
  const auto grown = std::find_if(grown_.begin(), grown_.end(), [&](const Grown& g) { return g.landmark == landmark; });
  if (grown == grown_.end()) return variance;
  const Eigen::Vector2d by_position = -graph().smoothed_pose(pose).to_map(seen.by_pose.head<2>());
  return by_position.dot(grown->covariance * by_position) +
         seen.by_pose.dot(belief.relative_to_newest(pose) * seen.by_pose);
}

void Hypothesis::remove_weak_landmarks() {
  std::erase_if(landmarks_, [&](LandmarkId id) {
    const std::vector<BearingId> bearings = graph().bearings_of(id);
    if (bearings.size() >= kFewestBearings || graph().is_known(id)) return false;
    if (settings_.tracks.used && !bearings.empty() && is_fresh(id)) return false;
    for (const BearingId bearing : bearings) smoother_.assign(bearing, kOfNothing);
    return true;
  });
}

}  // namespace azimuth
