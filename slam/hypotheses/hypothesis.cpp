#include "slam/hypotheses/hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/smoother/remembered_map.hpp"

namespace azimuth {
namespace {

// A new pair whose squared residual exceeds this after optimisation is dropped.
constexpr double kDropBeyondChi2 = 16.0;
// Images before the window are associated anew once in so many images.
constexpr PoseId kImagesBetweenWholeReviews = 10;
// Factor on asked_within_m() for the landmarks taken into account, since poses may move.
constexpr double kReach = 1.5;

SmootherSettings with_kernel(SmootherSettings settings, RobustKernel kernel) {
  settings.kernel = kernel;
  return settings;
}

}  // namespace

HypothesisSettings hypothesis_settings_for(double sigma_bearing_rad, double field_of_view_rad) {
  HypothesisSettings settings;
  settings.scene.sigma_bearing_rad = sigma_bearing_rad;
  settings.scene.field_of_view_rad = field_of_view_rad;
  settings.tracks.used = settings.scene.is_narrow();
  if (settings.tracks.used) {
    settings.scene.range_m = 8.0;
    settings.scene.detection_probability = 0.3;
  }
  settings.costs = hypothesis_costs(settings.scene, settings.smoother);
  return settings;
}

Hypothesis::Hypothesis(const HypothesisSettings& settings, const MemberSettings& member)
    : settings_(settings), member_(member), smoother_(with_kernel(settings.smoother, member.kernel)) {}

void Hypothesis::remember(const MapSnapshot& map, const Eigen::Matrix3d& moved) {
  landmarks_ = azimuth::remember(map, moved, smoother_);
  for (const MapLandmark& landmark : map.landmarks) {
    remembered_kinds_.push_back(landmark.kind);
    has_kinds_ = has_kinds_ || landmark.kind != kAnyKind;
  }
  while (time_s_.size() + 1 < graph().poses()) time_s_.push_back(0.0);
}

void Hypothesis::begin(std::span<const NamelessSighting> sightings) {
  time_s_.push_back(0.0);
  add_sightings(sightings);
  if (!settings_.tracks.used) return;
  begin_tracks();
  smoother_.optimise();
}

void Hypothesis::add_image(const Motion& motion, std::span<const NamelessSighting> sightings, double after_s) {
  grown_.clear();
  time_s_.push_back(time_s_.back() + after_s);
  ByLag by_lag = ByLag::Zero();
  by_lag.col(0) = motion.by_lag;
  smoother_.add_pose(motion, by_lag);
  add_sightings(sightings);
  associate(sightings);

  const PoseId from = images() % kImagesBetweenWholeReviews == 0 ? 0 : window_start();
  if (settings_.tracks.used) {
    begin_tracks();
    smoother_.optimise();
    end_tracks();
    merge();
    reassociate(WindowBelief(smoother_, window_start(), landmarks_, settings_.smoother.min_distance_m), from);
    return;
  }
  const WindowBelief belief(smoother_, window_start(), landmarks_near(window_start()),
                            settings_.smoother.min_distance_m);
  grow(belief, std::max(window_start(), images() - member_.anchors));
  reassociate(belief, from);
}

void Hypothesis::add_sightings(std::span<const NamelessSighting> sightings) {
  for (const NamelessSighting& sighting : sightings) {
    smoother_.add_bearing(sighting.azimuth_rad, sighting.sigma_rad);
    kinds_.push_back(sighting.kind);
    has_kinds_ = has_kinds_ || sighting.kind != kAnyKind;
  }
}

Kind Hypothesis::kind_of(LandmarkId id) const {
  if (!has_kinds_) return kAnyKind;
  const auto at = static_cast<std::size_t>(id);
  if (at < remembered_kinds_.size() && remembered_kinds_[at] != kAnyKind) return remembered_kinds_[at];
  for (const BearingId bearing : graph().bearings_of(id))
    if (kinds_[bearing] != kAnyKind) return kinds_[bearing];
  return kAnyKind;
}

void Hypothesis::associate(std::span<const NamelessSighting> sightings) {
  smoother_.optimise(0);
  const PoseId newest = images() - 1;
  PoseAndLandmarks belief{graph().camera_at(newest), {}, {}, {}};
  std::vector<Block> blocks{graph().block_of_pose(newest)};
  const std::vector<LandmarkId> near = landmarks_near(newest);
  for (const LandmarkId id : near) {
    belief.landmarks.push_back(graph().landmark(id));
    blocks.push_back(graph().block_of_landmark(id));
    if (has_kinds_) belief.kinds.push_back(kind_of(id));
  }
  belief.covariance = smoother_.factor().covariance(blocks, graph());

  ConditionedAssociationSettings settings;
  settings.scene = settings_.scene;
  settings.min_distance_m = settings_.smoother.min_distance_m;
  settings.reads_whole = !settings_.tracks.used;  // else an unassociated bearing becomes a landmark for now
  if (settings_.tracks.used)
    for (const LandmarkId id : near)
      settings.margins.push_back(is_fresh(id) ? settings_.tracks.fresh_margin : settings.min_margin);
  const std::vector<int> landmark_of = associate_conditioned(std::move(belief), sightings, settings);
  const BearingId first = first_bearing(newest);
  for (std::size_t i = 0; i < landmark_of.size(); ++i)
    if (landmark_of[i] >= 0)
      smoother_.assign(first + static_cast<BearingId>(i), near[static_cast<std::size_t>(landmark_of[i])]);
  smoother_.optimise();

  bool dropped = false;
  for (BearingId id = first; id < graph().bearings(); ++id)
    if (!is_unassigned(id) && graph().chi2_of(id) > kDropBeyondChi2) {
      smoother_.assign(id, kOfNothing);
      dropped = true;
    }
  if (dropped) smoother_.optimise();
}

/// The landmarks that the images from `since` on may show, even if their poses move. Leaving out the others saves the
/// time for their covariances. Through a narrow view these are all landmarks, since a landmark seen long ago may be
/// merged with a near one.
std::vector<LandmarkId> Hypothesis::landmarks_near(PoseId since) const {
  if (settings_.tracks.used) return landmarks_;
  const double reach_m = kReach * settings_.scene.asked_within_m();
  std::vector<LandmarkId> near;
  for (const LandmarkId id : landmarks_) {
    const SmoothedLandmark& landmark = graph().landmark(id);
    bool is_near = !landmark.is_point();
    for (PoseId image = since; image < images() && !is_near; ++image)
      is_near = (landmark.p_map() - graph().camera_at(image).T_map_body.position()).squaredNorm() < reach_m * reach_m;
    if (is_near) near.push_back(id);
  }
  return near;
}

void Hypothesis::assign(BearingId bearing, LandmarkId landmark) {
  smoother_.assign(bearing, landmark);
  std::erase_if(landmarks_, [&](LandmarkId id) { return !graph().is_unknown(id); });
  if (landmark != kOfNothing && std::find(landmarks_.begin(), landmarks_.end(), landmark) == landmarks_.end())
    landmarks_.push_back(landmark);
  smoother_.optimise();
}

void Hypothesis::correct(const Calibration& errors) {
  smoother_.correct(errors);
  smoother_.optimise();
}

void Hypothesis::forget(std::span<const PoseId> images) {
  const SharedPages<double> before_s = std::exchange(time_s_, {});
  const SharedPages<Kind> kinds_before = std::exchange(kinds_, {});
  auto next = images.begin();
  for (PoseId image = 0; image < before_s.size(); ++image) {
    if (next != images.end() && *next == image) {
      ++next;
      continue;
    }
    time_s_.push_back(before_s[image]);
    for (BearingId id = first_bearing(image); id < first_bearing(image + 1); ++id) kinds_.push_back(kinds_before[id]);
  }
  smoother_.forget(images);
  remove_weak_landmarks();
  smoother_.optimise();
}

void Hypothesis::adopt(const Hypothesis& other) {
  const MemberSettings member = member_;
  *this = other;
  member_ = member;
}

}  // namespace azimuth
