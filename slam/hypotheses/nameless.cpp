#include "slam/hypotheses/nameless.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/wrong_rig.hpp"

namespace azimuth {
namespace {

// Bearings nearer to each other than this, in standard deviations, cannot be told apart later. The value is below one:
// most of a bearing's error is common to all bearings of the image, so the difference of two bearings is better known
// than each of them.
constexpr double kNearSigmas = 0.6;
// Standard deviation [m, rad] of a motion of zero, which must still tie a pose to the one before.
constexpr double kStandsStill = 1e-6;
// Minimum number of bearings that each landmark keeps. They must also show later which bearings belong to the landmark.
constexpr std::size_t kBearingsKept = 16;
// Factor on the covariance. Members treat their associations as certain, so even when the associations are right,
// squared errors are 2 to 3 times as large as their covariances say. The same holds for drawn maps (VI.31).
constexpr double kOverconfident = 3.0;
constexpr PoseId kJudgementsInGraph = 10;  // the camera's yaw is judged when the graph has grown by one part of so many
constexpr double kNoPrior_rad = 1e3;       // a prior that tells nothing beside the bearings

/// Unites bearings that are too close to tell apart into their mean.
void unite_near(std::vector<NamelessSighting>& sightings) {
  std::stable_sort(sightings.begin(), sightings.end(),
                   [](const NamelessSighting& a, const NamelessSighting& b) { return a.azimuth_rad < b.azimuth_rad; });
  std::vector<NamelessSighting> united;
  int count = 0;
  for (const NamelessSighting& sighting : sightings) {
    if (!united.empty() && sighting.azimuth_rad - united.back().azimuth_rad < kNearSigmas * sighting.sigma_rad &&
        sighting.kind == united.back().kind) {
      ++count;
      united.back().azimuth_rad += (sighting.azimuth_rad - united.back().azimuth_rad) / count;
    } else {
      united.push_back(sighting);
      count = 1;
    }
  }
  sightings = std::move(united);
}

}  // namespace

Nameless::Nameless(const NamelessSettings& settings)
    : settings_(settings),
      beam_(settings.beam),
      motion_(settings.floors),
      whole_motion_(settings.floors),
      limit_(settings.max_keyframes, kBearingsKept) {
  if (!settings.beam.hypothesis.scene.is_narrow() || settings.drawn.populations == 0) return;
  settings_.drawn.map.hypothesis = settings.beam.hypothesis;
  drawn_.emplace(settings_.drawn);
}

void Nameless::remember(const MapSnapshot& map, const Eigen::Matrix3d& moved) {
  beam_.remember(map, moved);
  while (path_.newest() + 1 < beam_.images()) path_.add_pose();
  bearings_so_far_ = map.next_id;
  start_ = beam_.newest_pose();
  other_answers_.assign(as_size(beam_.images()), start_);
  drawn_.reset();  // drawn maps cannot start from a saved map
  evidence_ = trust_evidence(beam_, odometry_alone());
}

void Nameless::predict(const Motion& motion) {
  motion_.append_motion(motion);
  if (has_begun()) whole_motion_.append_motion(motion);
}

/// Turns the pose into a motion from the last image, which then applies to all members.
void Nameless::place(const Beam::PoseBelief& robot) {
  const Pose2& from = beam_.best().smoother().newest_pose();
  Eigen::Matrix3d to_start = Eigen::Matrix3d::Identity();
  to_start.topLeftCorner<2, 2>() = rotation(-from.heading_rad);
  Motion motion;
  motion.T_start_end = inverse(from) * robot.T_map_body;
  motion.covariance = to_start * robot.covariance * to_start.transpose();
  motion.path_m = motion.T_start_end.position().norm();
  motion_.pose_added();
  motion_.append_motion(motion);
  whole_motion_.pose_added();
  start_ = robot;
}

bool Nameless::is_used(const BearingSet& set) const {
  if (!last_used_) return true;
  return since_anchor().moved() &&
         (to_seconds(set.stamp - *last_used_) >= settings_.thinning_s || since_anchor().path_m >= settings_.far_m);
}

bool Nameless::update(const BearingSet& set, Workers& workers) {
  motion_.image_taken(set.stamp);
  whole_motion_.image_taken(set.stamp);
  if (!is_used(set)) return false;

  sightings_.clear();
  const double sigma_rad = settings_.beam.hypothesis.scene.sigma_bearing_rad;
  for (const Bearing& bearing : set.bearings)
    sightings_.push_back({camera_yaw_.doubted ? wrap(bearing.azimuth_rad + camera_yaw_.error_rad) : bearing.azimuth_rad,
                          std::isnan(bearing.sigma_rad) ? sigma_rad : bearing.sigma_rad, bearing.kind});
  if (settings_.beam.hypothesis.tracks.used) unite_near(sightings_);
  if (has_begun()) {
    const double after_s = last_used_ ? to_seconds(set.stamp - *last_used_) : 0.0;
    beam_.add_image(way_to_image(), sightings_, workers, after_s);
    if (drawn_) drawn_->add_image(way_to_image(), sightings_, workers, after_s);
    path_.add_pose();
  } else {
    beam_.begin(sightings_);
    if (drawn_) drawn_->begin(sightings_, workers);
  }
  for (std::size_t i = 0; i < sightings_.size(); ++i) bearing_numbers_.push_back(bearings_so_far_++);
  last_used_ = set.stamp;
  motion_.pose_added();
  judge_yaw(workers);
  evidence_ = trust_evidence(beam_, odometry_alone());
  recent_doubts_.add(evidence_);
  other_answers_.push_back(is_drawn() ? pose_by_drawn_maps() : odometry_alone());
  return true;
}

/// Judges the camera's yaw from the best member's whole graph, again whenever the graph has grown by a tenth.
void Nameless::judge_yaw(Workers& workers) {
  const double narrow_rad = settings_.sigma_yaw_rad, wide_rad = settings_.sigma_yaw_if_wrong_rad;
  if (drawn_ || !(narrow_rad > 0.0 && wide_rad > narrow_rad)) return;
  if (kJudgementsInGraph * ++images_since_judged_ < beam_.images()) return;
  images_since_judged_ = 0;
  const Smoother::Told told = beam_.best().smoother().camera_yaw_rad();
  const double information = told.information;
  if (!(information > 0.0)) return;
  const double error_rad = camera_yaw_.error_rad + told.value;  // without a prior
  const double log_odds = log_evidence(error_rad, 1.0 / information, kNoPrior_rad, wide_rad, narrow_rad);
  CameraYaw next;
  next.doubted = log_odds > (camera_yaw_.doubted ? kLogOddsToStay : kLogOddsToDoubt) &&
                 std::abs(error_rad) < kPossible_sigmas * wide_rad;
  if (next.doubted) {
    const double variance_rad2 = 1.0 / (information + 1.0 / (wide_rad * wide_rad));
    next.error_rad = variance_rad2 * information * error_rad;
    next.sigma_rad = std::sqrt(variance_rad2);
  }
  const double turn_rad = next.error_rad - camera_yaw_.error_rad;
  camera_yaw_ = next;
  if (turn_rad != 0.0) beam_.turn_bearings(turn_rad, workers);
}

void Nameless::forget(Workers& workers) {
  const BearingGraph& graph = beam_.best().graph();
  const std::vector<PoseId> images = limit_.least_worth(graph, path_.numbers());
  if (!images.empty()) {
    std::vector<std::int64_t> left;
    auto next = images.begin();
    for (PoseId image = 0; image < graph.poses(); ++image) {
      if (next != images.end() && *next == image) {
        ++next;
        continue;
      }
      for (BearingId id = graph.first_bearing_of(image); id < graph.first_bearing_of(image + 1); ++id)
        left.push_back(number_of(id));
    }
    bearing_numbers_ = std::move(left);
    path_.forget(graph, images);
    beam_.forget(images, workers);
    evidence_ = trust_evidence(beam_, odometry_alone());
  }
  limit_.forgotten(beam_.best().graph());
}

Beam::PoseBelief Nameless::past(PoseNumber number) const {
  BelievedPose by_beam = beam_.mixture([&](const Hypothesis& member) -> Beam::PoseBelief {
    const ThinnedPath::Told told = path_.tell(number, member.smoother());
    return {told.T_map_body, told.covariance};
  });
  by_beam.covariance *= kOverconfident;
  const BelievedPose& other = other_answers_[as_size(number)];
  // The beam's estimate includes later images, while drawn maps are wrong less often. Nothing tells which estimate to
  // prefer, so each counts half.
  return is_drawn() ? one_of_two(by_beam, other, 0.5, 0.5)
                    : one_of_two(by_beam, other, probability_all_wrong(evidence_), 0.0);
}

Beam::PoseBelief Nameless::pose() const { return is_drawn() ? since_image(pose_by_drawn_maps()) : pose_by_beam(); }

/// Odometry alone is not mixed in: where maps are wrong, the populations differ accordingly.
Beam::PoseBelief Nameless::pose_by_drawn_maps() const {
  BelievedPose belief = drawn_->pose();
  belief.covariance *= kOverconfident;
  return belief;
}

Beam::PoseBelief Nameless::pose_by_beam() const {
  BelievedPose by_beam = since_image(beam_.newest_pose());
  by_beam.covariance *= kOverconfident;
  // A pose between two candidates is nearer to both. But odometry that the map clearly contradicts may itself be wrong,
  // and then share_of_odometry() is small.
  return one_of_two(by_beam, odometry_alone(), probability_all_wrong(evidence_), share_of_odometry(evidence_));
}

Beam::PoseBelief Nameless::since_image(Beam::PoseBelief belief) const {
  if (!since_anchor().moved()) return belief;
  const MovedPose moved = apply(belief.T_map_body, since_anchor_with_floors());
  return {moved.T_map_body, moved.G * belief.covariance * moved.G.transpose() + moved.noise};
}

Motion Nameless::way_to_image() const {
  Motion way = since_anchor_with_floors();
  if (!way.moved()) way.covariance.diagonal().setConstant(kStandsStill * kStandsStill);
  return way;
}

Beam::PoseBelief Nameless::odometry_alone() const {
  const Motion motion = whole_motion_.with_floors();
  const Eigen::Vector2d sigmas(settings_.sigma_scale_distance, settings_.sigma_scale_turn);
  const ByScales by_scales = motion.by_scales * sigmas.asDiagonal();
  const MovedPose moved = apply(start_.T_map_body, motion);
  Motion by_scale = motion;
  by_scale.covariance = by_scales * by_scales.transpose();
  return {moved.T_map_body,
          moved.G * start_.covariance * moved.G.transpose() + moved.noise + apply(start_.T_map_body, by_scale).noise};
}

}  // namespace azimuth
