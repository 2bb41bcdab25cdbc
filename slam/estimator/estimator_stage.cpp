#include "slam/estimator/estimator_stage.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "slam/estimator/rig_noise.hpp"

namespace azimuth {
namespace {

/// Whether the first reading continues the odometry of the saved map, soon enough for the motion in between to be
/// known.
bool follows(const OdometryReading& first, const OdometrySince& since) {
  const OdometryReading& kept = since.reading;
  return first.origin == kept.origin && first.stamp > kept.stamp &&
         !is_vague(since.motion, first.sigma_gap_m, first.sigma_gap_rad);
}

constexpr double kExplainedChi2 = 16.27;            // 99.9 % quantile, three degrees of freedom
constexpr double kSmallest = 1e-6;                  // absorbs rounding [m, rad]
constexpr double kVague_m = 1.0, kVague_rad = 0.3;  // standard deviations

}  // namespace

EstimatorStage::EstimatorStage(std::unique_ptr<Estimator> estimator, const Rig& rig, const StageSettings& settings,
                               const std::optional<OdometrySince>& since)
    : estimator_(std::move(estimator)),
      wait_limit_(duration_from_seconds(settings.wait_for_odometry_s)),
      clock_(rig.odometry),
      azimuths_clockwise_(rig.camera.azimuths_clockwise),
      has_names_(rig.camera.identities),
      sigma_bearing_rad_(rig.camera.sigma_bearing_rad),
      odometry_rig_(rig.odometry),
      track_(rig.odometry),
      samples_(rig, wait_limit_),
      since_(since),
      intake_(clock_) {
  assert(estimator_);
}

bool EstimatorStage::add(const OdometryReading& reading) {
  if (!intake_.takes(reading)) return false;
  if (!begun_) begin(reading);
  track_.add(reading);
  samples_.add(reading);
  return true;
}

/// After a restart of the daemon the odometer may have kept counting: then the motion from the saved map to the first
/// reading is known, and so is the pose.
void EstimatorStage::begin(const OdometryReading& first) {
  begun_ = true;
  const bool goes_on = estimator_->odometry_begins(since_ && follows(first, *since_));
  if (since_) goes_on_ = goes_on;
  if (!goes_on) return;
  track_.go_on(*since_);
  Estimate start;
  estimator_->estimate(start);
  reckoning_.begin(since_->map, {start.T_map_body, start.pose_covariance});
}

void EstimatorStage::add(BearingSet& set) {
  if (!intake_.takes(set)) return set.clear();
  samples_.add(set);
  intake_.keep_usable(set);
  if (azimuths_clockwise_)
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(-bearing.azimuth_rad);
  if (waiting_.full()) refuse_first();  // no odometry for a long time: the oldest set will never be used
  waiting_.add(set);
}

bool EstimatorStage::advance(Estimate& out) {
  while (!waiting_.empty()) {
    switch (readiness(waiting_.first().stamp)) {
      case Readiness::wait:
        return false;
      case Readiness::never:
        give_up_first();
        break;
      case Readiness::ready:
        if (has_names_) intake_.doubt_repeated_names(waiting_.first(), sigma_bearing_rad_);
        step(waiting_.first(), out);
        waiting_.drop_first();
        return true;
    }
  }
  return false;
}

/// Whether the odometry pose at `stamp` can be interpolated. Only the samples' stamps decide, not the times at which
/// they arrived.
EstimatorStage::Readiness EstimatorStage::readiness(Stamp stamp) const {
  // All readings stamped before the newest set came before it; a reading is valid earlier than its stamp by the lead.
  const bool limit_passed = finished_ || intake_.newest_set() - lead() > stamp + wait_limit_;
  if (track_.empty()) return limit_passed ? Readiness::never : Readiness::wait;
  // Before the first reading the robot's pose is unknown, since the robot may have been driving.
  if (stamp < track_.oldest()) return Readiness::never;
  if (const auto next = track_.first_from(stamp)) {
    const bool is_known = *next <= stamp + wait_limit_ && !track_.is_blind_at(stamp, wait_limit_);
    return is_known ? Readiness::ready : Readiness::never;
  }
  if (!limit_passed) return Readiness::wait;
  return Readiness::never;
}

/// By how much stamps of readings are later than the instants that the readings are valid for.
Duration EstimatorStage::lead() const {
  const Duration lag = track_.empty() ? clock_.lag_at_first() : track_.newest() - track_.newest_raw().stamp;
  return std::max(Duration{0}, -lag);
}

void EstimatorStage::step(const BearingSet& set, Estimate& out) {
  const OdometryTrack::Step odometry = track_.advance_to(set.stamp);
  last_step_ = set.stamp;
  ++steps_;
  samples_.used();
  estimator_->predict(odometry.motion);
  if (before_update_) before_update_(set, *estimator_);
  estimator_->update(set);
  samples_.found(estimator_->rig_finding());
  out.landmarks.clear();
  out.accepted.clear();
  estimator_->estimate(out);
  out.predicted = false;
  last_belief_ = {out.T_map_body, out.pose_covariance};
  const Motion motion = with_floors(odometry.motion, odometry_rig_);
  reckoning_.add(motion, last_belief_, out.health);
  reckoning_made_.add(motion, last_belief_, out.health);
  finish_estimate(set.stamp, odometry.T_odom_body, out);
}

bool EstimatorStage::look_ahead(Estimate& out) {
  if (track_.empty() || (last_step_ && track_.newest() <= *last_step_)) return false;
  if (last_look_ && track_.newest() <= *last_look_) return false;
  last_look_ = track_.newest();
  const OdometryTrack::Step odometry = track_.peek();
  out.landmarks.clear();
  out.accepted.clear();
  estimator_->look_ahead(odometry.motion, out);
  out.predicted = true;
  finish_estimate(track_.newest(), odometry.T_odom_body, out);
  return true;
}

bool EstimatorStage::save_map(MapSnapshot& out) const {
  if (!last_step_ || !estimator_->save_map(out)) return false;
  out.stamp = *last_step_;
  return true;
}

void EstimatorStage::map_is_made() { reckoning_made_.begin(*last_step_, last_belief_); }

void EstimatorStage::map_is_kept() { reckoning_ = std::exchange(reckoning_made_, {}); }

bool EstimatorStage::since(const DeadReckoning& reckoning, OdometrySince& out) const {
  std::optional<Motion> motion = reckoning.motion();
  if (!motion || track_.empty()) return false;
  const OdometryTrack::Step running = track_.peek();
  append(*motion, running.motion);
  out = {.map = reckoning.map(), .motion = *motion, .reading = track_.newest_raw(), .T_odom_body = running.T_odom_body};
  return true;
}

void EstimatorStage::finish_estimate(Stamp stamp, const Pose2& T_odom_body, Estimate& out) {
  out.stamp = stamp;
  out.sequence = ++sequence_;
  out.step = steps_;
  out.T_odom_body = T_odom_body;
  out.input = intake_.counts();
  out.association.rejected += intake_.names_doubted();
  const SampleTrouble trouble = out.health == Health::starting ? samples_.trouble() : SampleTrouble::none;
  if (trouble != SampleTrouble::none) out.reason = to_string(trouble);
  if (const SampleTrouble impossible = samples_.impossible();
      impossible != SampleTrouble::none && out.health != Health::starting) {
    out.health = Health::lost;
    out.reason = to_string(impossible);
  }
}

void EstimatorStage::finish() {
  finished_ = true;
  samples_.finish();
}

void EstimatorStage::give_up_first() {
  const Stamp stamp = waiting_.first().stamp;
  if (!finished_ && !track_.first_from(stamp)) intake_.gave_up_until(stamp + wait_limit_);
  refuse_first();
}

void EstimatorStage::refuse_first() {
  intake_.refused_set();
  samples_.refused();
  waiting_.drop_first();
}

bool is_vague(const Motion& motion, double sigma_gap_m, double sigma_gap_rad) {
  const Eigen::Vector3d variances = motion.covariance.diagonal();
  return variances.head<2>().maxCoeff() + sigma_gap_m * sigma_gap_m > kVague_m * kVague_m ||
         variances.z() + sigma_gap_rad * sigma_gap_rad > kVague_rad * kVague_rad;
}

void DeadReckoning::begin(Stamp map, const PoseBelief& pose) {
  map_ = map;
  start_ = pose;
  motion_ = {};
}

void DeadReckoning::add(const Motion& motion, const PoseBelief& now, Health health) {
  if (!start_) return;
  append(motion_, motion);
  if (health == Health::lost || !explains(now)) start_.reset();
}

/// Whether the robot is where the motion would put it. `now` includes all bearings since the start, so the uncertainty
/// of `now` is neglected.
bool DeadReckoning::explains(const PoseBelief& now) const {
  const PoseBelief predicted = moved(*start_, motion_);
  Eigen::Vector3d apart = now.T_map_body.vector() - predicted.T_map_body.vector();
  apart.z() = wrap(apart.z());
  const Eigen::Matrix3d covariance = predicted.covariance + kSmallest * kSmallest * Eigen::Matrix3d::Identity();
  return apart.dot(covariance.ldlt().solve(apart)) <= kExplainedChi2;
}

std::optional<Motion> DeadReckoning::motion() const {
  if (!start_ || is_vague(motion_)) return std::nullopt;
  return motion_;
}

}  // namespace azimuth
