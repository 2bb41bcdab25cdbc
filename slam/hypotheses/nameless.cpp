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
constexpr PoseId kJudgementsInGraph = 10;  // the rig is judged when the graph has grown by one part of so many

/// The motion of a robot whose odometry has these errors.
Motion without(const Calibration& errors, Motion motion) {
  if (errors.isZero(0.0)) return motion;
  const Eigen::Vector3d off = motion.by_scales * errors.segment<2>(calibration::scale_distance) +
                              motion.by_drift * errors[calibration::drift] + motion.by_lag * errors[calibration::lag];
  Pose2& T = motion.T_start_end;
  T = {T.x_m + off.x(), T.y_m + off.y(), wrap(T.heading_rad + off.z())};
  return motion;
}

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
  start_number_ = path_.newest();
  other_answers_.assign(as_size(beam_.images()), start_);
  drawn_.reset();  // drawn maps cannot start from a saved map
  evidence_ = trust_evidence(beam_, odometry_alone());
}

void Nameless::predict(const Motion& motion) {
  const Motion right = without(corrected_, motion);
  motion_.append_motion(right);
  if (has_begun()) whole_motion_.append_motion(right);
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
  start_number_ = path_.newest() + 1;
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
    sightings_.push_back(
        {corrected_.isZero(0.0) ? bearing.azimuth_rad : wrap(bearing.azimuth_rad + corrected_[calibration::yaw]),
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
  judge_rig(workers);
  evidence_ = trust_evidence(beam_, odometry_alone());
  recent_doubts_.add(evidence_);
  other_answers_.push_back(is_drawn() ? pose_by_drawn_maps() : odometry_alone());
  return true;
}

/// Judges the rig from the best member's whole graph, again whenever the graph has grown by a tenth.
void Nameless::judge_rig(Workers& workers) {
  const Calibration said = sigmas(settings_.rig), if_wrong = sigmas(settings_.rig_if_wrong);
  if (drawn_ || kJudgementsInGraph * ++images_since_judged_ < beam_.images()) return;
  images_since_judged_ = 0;
  RigEvidence<kCalibrations> evidence = beam_.best().smoother().rig_evidence();
  evidence.pull += evidence.information * corrected_;  // of the whole error
  const auto before = rig_errors_.doubted;
  // A wrong yaw shows in every image, long before the drive tells it apart from a wrong place of the camera. It is
  // therefore also judged with the other values as the rig states them.
  Calibration variance = Calibration::Zero();
  variance[calibration::yaw] = said[calibration::yaw] * said[calibration::yaw];
  auto suspected = before;
  if (judged<kCalibrations>(evidence, variance, if_wrong, before).is_doubted(calibration::yaw))
    suspected[calibration::yaw] = true;
  rig_errors_ = judged<kCalibrations>(evidence, said.cwiseAbs2(), if_wrong, suspected);
  const Calibration errors = rig_errors_.believable();
  fits_no_rig_ = (errors.cwiseAbs().array() > kPossible_sigmas * if_wrong.array()).any();
  if (fits_no_rig_) rig_errors_ = {.sigma = said};
  if (const Calibration more = rig_errors_.believable() - corrected_; !more.isZero(0.0)) correct(more, workers);
  if (rig_errors_.doubted != before) recent_doubts_ = {};  // they were about the rig as it was
}

/// Corrects all that was measured so far. What odometry alone told is composed anew, since a wrong scale of turns bends
/// long ways by more than a first order tells.
void Nameless::correct(const Calibration& errors, Workers& workers) {
  corrected_ += errors;
  beam_.correct(errors, workers);
  const BearingGraph& graph = beam_.best().graph();
  const std::vector<PoseNumber>& numbers = path_.numbers();
  const auto start = std::ranges::lower_bound(numbers, start_number_);
  auto id = static_cast<PoseId>(start - numbers.begin());
  start_.T_map_body = graph.pose(id);
  Motion way;
  while (++id < graph.poses()) {
    append(way, motion_of(graph.odometry_to(id)));
    whole_motion_.restart(way);
    if (const std::size_t number = as_size(numbers[as_size(id)]); number < other_answers_.size())
      other_answers_[number] = odometry_alone();
  }
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
