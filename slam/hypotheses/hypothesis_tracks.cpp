// Landmarks through a narrow view: each unassociated bearing starts a landmark at once, and duplicates are merged later
// (mathematics VI.20).

#include <algorithm>
#include <cmath>

#include "slam/hypotheses/hypothesis.hpp"
#include "slam/hypotheses/same_landmarks.hpp"

namespace azimuth {
namespace {

// Bounds on the increase of the squared residuals by merging, with k degrees of freedom: 3.1 standard deviations of
// their sum (99.9 %), plus 4 for nonlinearity.
constexpr double kMostSigmas = 3.1, kNotLinear = 4.0;

}  // namespace

void Hypothesis::begin_tracks() {
  for (BearingId id = first_bearing(images() - 1); id < graph().bearings(); ++id)
    if (is_unassigned(id)) landmarks_.push_back(smoother_.add_landmark(id));
}

/// Removes landmarks that have few bearings and are no longer fresh.
void Hypothesis::end_tracks() {
  bool gone = false;
  std::erase_if(landmarks_, [&](LandmarkId id) {
    if (is_established(id) || is_fresh(id)) return false;
    const std::vector<BearingId> bearings = graph().bearings_of(id);
    for (const BearingId bearing : bearings) smoother_.assign(bearing, kOfNothing);
    return gone = true;
  });
  if (gone) smoother_.optimise();
}

PoseId Hypothesis::last_seen(LandmarkId id) const {
  PoseId last = 0;
  for (const BearingId bearing : graph().bearings_of(id)) last = std::max(last, graph().bearing(bearing).pose);
  return last;
}

bool Hypothesis::is_fresh(LandmarkId id) const {
  return time_s_.back() - time_s_[last_seen(id)] <= settings_.tracks.fresh_s;
}

bool Hypothesis::is_established(LandmarkId id) const {
  return graph().is_known(id) || graph().bearings_of(id).size() >= settings_.tracks.fewest_bearings;
}

void Hypothesis::merge() {
  std::vector<LandmarkId> known;
  std::vector<std::vector<PoseId>> seen_from;
  std::vector<Block> blocks;
  LandmarkBeliefs beliefs;
  for (const LandmarkId id : landmarks_) {
    if (!is_established(id)) continue;
    known.push_back(id);
    blocks.push_back(graph().block_of_landmark(id));
    beliefs.landmarks.push_back(graph().landmark(id));
    std::vector<PoseId>& poses = seen_from.emplace_back();
    for (const BearingId bearing : graph().bearings_of(id)) poses.push_back(graph().bearing(bearing).pose);
    std::sort(poses.begin(), poses.end());
  }
  const auto last_of = [](const std::vector<PoseId>& poses) { return poses.empty() ? -1 : poses.back(); };
  // Two landmarks seen in one image are different.
  std::vector<LandmarkPair> possible;
  for (std::size_t newer = 0; newer < known.size(); ++newer)
    for (std::size_t older = 0; older < newer; ++older) {
      if (std::max(last_of(seen_from[newer]), last_of(seen_from[older])) < window_start()) continue;
      if (!same_kind(kind_of(known[newer]), kind_of(known[older]))) continue;
      std::vector<PoseId> both;
      std::set_intersection(seen_from[newer].begin(), seen_from[newer].end(), seen_from[older].begin(),
                            seen_from[older].end(), std::back_inserter(both));
      if (both.empty()) possible.push_back({older, newer});
    }
  if (possible.empty()) return;
  beliefs.covariance = smoother_.factor().covariance(blocks, graph());

  SameLandmarksSettings settings;
  settings.log_detection = std::log(settings_.scene.detection_probability);
  settings.log_new = std::log(settings_.scene.new_per_rad);
  settings.inverse_depth_mean_per_m = settings_.smoother.inverse_depth_mean_per_m;
  settings.inverse_depth_sigma_per_m = settings_.smoother.inverse_depth_sigma_per_m;
  settings.min_margin = member_.merge_margin + settings_.tracks.extra_merge_margin;
  const std::vector<LandmarkPair> same = same_landmarks(std::move(beliefs), possible, settings);
  if (same.empty()) return;

  const Hypothesis before = *this;
  for (const LandmarkPair& pair : same) {
    smoother_.merge(known[pair.older], known[pair.newer]);
    std::erase(landmarks_, known[pair.newer]);
  }
  smoother_.optimise();
  const double k = 2.0 * static_cast<double>(same.size());
  const double most = k + kMostSigmas * std::sqrt(2.0 * k) + kNotLinear;
  if (2.0 * (smoother_.energy() - before.smoother_.energy()) > most || energy() > before.energy()) *this = before;
}

}  // namespace azimuth
