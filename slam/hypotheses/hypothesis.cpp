#include "slam/hypotheses/hypothesis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "slam/smoother/remembered_map.hpp"

namespace azimuth {
namespace {

/// Spreads a setting evenly over [low, high) for any number of members. The irrational stride acts like a golden
/// section; each setting has its own stride.
double spread(int member, double stride, double low, double high) {
  const double turns = member * stride;
  return low + (turns - std::floor(turns)) * (high - low);
}

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

// Number of images after a landmark's last bearing in which it can count as missed. After that the landmark counts as
// gone.
constexpr PoseId kMissedAfterLast = 12;

}  // namespace

std::vector<MemberSettings> differing_members(int count) {
  constexpr std::array kKernels{RobustKernel::cauchy, RobustKernel::dcs, RobustKernel::huber};
  std::vector<MemberSettings> members;
  for (int i = 0; i < count; ++i) {
    MemberSettings member;
    if (i > 0) {
      member.window = static_cast<int>(std::lround(spread(i, 0.6180339887, 9.0, 20.0)));
      member.min_hits = spread(i, 0.4142135624, 0.0, 1.0) < 0.5 ? 4 : 5;
      member.min_fall = spread(i, 0.7320508076, 4.0, 10.0);
      member.rival_gap = spread(i, 0.2360679775, 1.0, 2.0);
      member.merge_margin = spread(i, 0.3166247904, 2.0, 5.0);
      member.missed_scale = spread(i, 0.6457513111, 0.0, 1.0) < 0.5 ? 1.0 : 1.3;
      member.kernel = kKernels[static_cast<std::size_t>(i) % kKernels.size()];
    }
    if (i % 4 > 1) member.anchors = 3;
    if (i % 4 == 3) member.past_stands = false;
    if (i % 2 == 1) {
      member.step_fall = 2.0;
      member.min_log_ratio = 3.0;
    }
    members.push_back(member);
  }
  return members;
}

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

// The cost of a hypothesis (mathematics VI.20).

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
