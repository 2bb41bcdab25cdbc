#include "slam/smoother/known_names.hpp"

#include <algorithm>
#include <cmath>

#include "slam/smoother/remembered_map.hpp"

namespace azimuth {
namespace {

// A landmark's prior is switched off once its bearings have this many times the prior's information. The landmark's
// standard deviation is then a fifth of the prior's, and a prior mean that is off by one prior standard deviation
// shifts the landmark by a fifth of its own.
constexpr double kToldWithoutPrior = 25.0;

std::optional<MeasuredElevation> elevation_of(const Bearing& bearing) {
  if (!std::isfinite(bearing.elevation_rad) || !std::isfinite(bearing.sigma_elevation_rad)) return std::nullopt;
  return MeasuredElevation{bearing.elevation_rad, bearing.sigma_elevation_rad};
}

SmootherSettings for_long_ways(SmootherSettings settings) {
  settings.charts_go_along = true;
  return settings;
}

}  // namespace

KnownNames::KnownNames(const KnownNamesSettings& settings)
    : settings_(settings),
      smoother_(for_long_ways(settings.smoother)),
      motion_(settings.floors),
      rig_(rig_belief(settings.smoother.calibration)),
      limit_(settings.max_keyframes) {}

void KnownNames::remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) {
  const std::vector<LandmarkId> landmarks = azimuth::remember(map, moved, smoother_);
  while (path_.newest() + 1 < smoother_.graph().poses()) path_.add_pose();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    Known& known = known_[map.landmarks[i].identity];
    if (known.landmark != kOfNothing) replaced_[static_cast<std::size_t>(known.landmark)] = 1;
    known.landmark = landmarks[i];
    names_.push_back(map.landmarks[i].identity);
    replaced_.push_back(0);
  }
}

void KnownNames::predict(const Motion& motion) { motion_.append_motion(motion); }

bool KnownNames::is_due(const Known& known, Stamp stamp) const {
  if (known.landmark == kOfNothing) return true;
  if (stands_at(known.last_from) && known.from_there >= settings_.most_from_one_place) return false;
  return !known.last_used || to_seconds(stamp - *known.last_used) >= settings_.thinning_s;
}

bool KnownNames::update(const BearingSet& set) {
  motion_.image_taken(set.stamp);
  last_image_ = {.first = smoother_.graph().bearings()};
  bool used_any = false;
  for (const Bearing& bearing : set.bearings) {
    if (bearing.identity == kUnknownIdentity) continue;
    Known& known = known_[bearing.identity];
    if (!is_due(known, set.stamp)) {
      ++last_image_.thinned;
      continue;
    }
    if (!used_any && since_anchor().moved()) {
      add_pose(since_anchor_with_floors());
    }
    used_any = true;
    use(bearing, known, set.stamp);
  }
  if (!used_any) return false;
  outcome_ = smoother_.optimise();
  reinitialise_contradicted();
  weigh_priors();
  return true;
}

void KnownNames::add_pose(const Motion& motion) {
  ByLag by_lag = ByLag::Zero();
  by_lag.col(0) = motion.by_lag;
  smoother_.add_pose(motion, by_lag);
  path_.add_pose();
  motion_.pose_added();
}

void KnownNames::forget(std::span<const PoseId> poses) {
  const BearingGraph& graph = smoother_.graph();
  forgotten_bearings_.resize(static_cast<std::size_t>(graph.landmarks()));
  for (const PoseId pose : poses)
    for (BearingId id = graph.first_bearing_of(pose); id < graph.first_bearing_of(pose + 1); ++id)
      ++forgotten_bearings_[static_cast<std::size_t>(graph.landmark_of(id))];
  path_.forget(graph, poses);
  const BearingId of_last_image = graph.bearings() - last_image_.first;
  if (!poses.empty()) {
    smoother_.forget(poses);
    for (LandmarkId id = 0; id < graph.landmarks(); ++id)
      if (!graph.is_known(id) && !is_told(id)) smoother_.use_prior(id, true);
    outcome_ = smoother_.optimise();
  }
  last_image_.first = graph.bearings() - of_last_image;
  limit_.forgotten(graph);
}

void KnownNames::use(const Bearing& bearing, Known& known, Stamp stamp) {
  const double said_rad = std::isnan(bearing.sigma_rad) ? settings_.sigma_bearing_rad : bearing.sigma_rad;
  const double sigma_rad = rig_.bearing_noise * said_rad;
  const BearingId id = smoother_.add_bearing(bearing.azimuth_rad, sigma_rad, elevation_of(bearing));
  if (known.landmark == kOfNothing) {
    known.landmark = initialise(id, bearing.identity);
    ++last_image_.initialised;
  } else {
    smoother_.assign(id, known.landmark);
  }
  known.last_used = stamp;
  known.from_there = known.last_from == anchor() ? known.from_there + 1 : 1;
  known.last_from = anchor();
}

LandmarkId KnownNames::initialise(BearingId first, Identity name) {
  names_.push_back(name);
  replaced_.push_back(0);
  return smoother_.add_landmark(first);
}

/// Whether the landmark's bearings alone determine its distance.
bool KnownNames::is_told(LandmarkId landmark) const {
  const double sigma_per_m = settings_.smoother.inverse_depth_sigma_per_m;
  return smoother_.graph().told_information(landmark) * sigma_per_m * sigma_per_m > kToldWithoutPrior;
}

/// Switches off the priors of landmarks that their bearings determine. Landmarks come into view at similar distances,
/// so the errors of their priors are correlated; hundreds of priors would outweigh odometry in the length and the
/// curvature of the path. A prior is switched on again when bearings that determined the distance turn out to be wrong
/// associations.
void KnownNames::weigh_priors() {
  const BearingGraph& graph = smoother_.graph();
  for (BearingId id = last_image_.first; id < graph.bearings(); ++id)
    if (const LandmarkId landmark = graph.landmark_of(id); !graph.is_known(landmark))
      smoother_.use_prior(landmark, !is_told(landmark));
}

/// Initialises contradicted landmarks anew. A landmark whose first bearing carried a wrong identity lies in a wrong
/// place that no small step corrects. When no bearing of an image fits, the pose is wrong instead.
void KnownNames::reinitialise_contradicted() {
  const BearingGraph& graph = smoother_.graph();
  const BearingId end = graph.bearings();
  bool any_agrees = false;
  for (BearingId id = last_image_.first; id < end; ++id) {
    Known& known = known_[names_[static_cast<std::size_t>(graph.landmark_of(id))]];
    any_agrees = any_agrees || (agrees(id) && graph.bearings_of(known.landmark).size() > 1);
    known.refused_in_row = agrees(id) ? 0 : known.refused_in_row + 1;
  }
  if (!any_agrees || settings_.reinitialise_after <= 0) return;
  for (BearingId id = last_image_.first; id < end; ++id) {
    const Identity name = names_[static_cast<std::size_t>(graph.landmark_of(id))];
    Known& known = known_[name];
    if (known.refused_in_row >= settings_.reinitialise_after && reinitialise(name, known)) ++last_image_.reinitialised;
  }
}

/// Initialises the landmark anew on the ray of its newest bearing. Returns false and restores everything when the
/// energy does not fall.
bool KnownNames::reinitialise(Identity name, Known& known) {
  const std::vector<BearingId> bearings = smoother_.graph().bearings_of(known.landmark);
  const Smoother before = smoother_;
  const LandmarkId anew = initialise(bearings.back(), name);
  for (const BearingId bearing : bearings) smoother_.assign(bearing, anew);
  outcome_ = smoother_.optimise();
  known.refused_in_row = 0;
  if (smoother_.energy() >= before.energy()) {
    smoother_ = before;
    names_.pop_back();
    replaced_.pop_back();
    return false;
  }
  replaced_[static_cast<std::size_t>(known.landmark)] = 1;
  known.landmark = anew;
  return true;
}

void KnownNames::adopt(const KnownNames& other) {
  const KnownNamesSettings own = settings_;
  *this = other;
  settings_ = own;
  smoother_.set_kernel(own.smoother.kernel, own.smoother.kernel_width);
  outcome_ = smoother_.optimise();
}

void KnownNames::place(const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
  const Pose2& from = smoother_.newest_pose();
  Eigen::Matrix3d to_body = Eigen::Matrix3d::Identity();
  to_body.topLeftCorner<2, 2>() = rotation(-from.heading_rad);
  Motion motion;
  motion.T_start_end = inverse(from) * T_map_body;
  motion.covariance = to_body * covariance * to_body.transpose();
  add_pose(motion);
  last_image_ = {.first = smoother_.graph().bearings()};
  outcome_ = smoother_.optimise();
}

void KnownNames::believe(const RigBelief& rig) {
  if (change(smoother_, rig_, rig)) outcome_ = smoother_.optimise();
  rig_ = rig;
}

Motion KnownNames::since_anchor_with_floors() const {
  Motion motion = motion_.with_floors();
  motion.covariance *= rig_.odometry_noise * rig_.odometry_noise;
  return motion;
}

Pose2 KnownNames::pose() const { return smoother_.newest_pose() * since_anchor().T_start_end; }

Eigen::Matrix3d KnownNames::covariance() const {
  const Eigen::Matrix3d P = smoother_.newest_covariance();
  if (!since_anchor().moved()) return P;
  const MovedPose moved = apply(smoother_.newest_pose(), since_anchor_with_floors());
  return moved.G * P * moved.G.transpose() + moved.noise;
}

}  // namespace azimuth
