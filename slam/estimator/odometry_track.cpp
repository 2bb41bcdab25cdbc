#include "slam/estimator/odometry_track.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

// Length at which a segment ends, so that noise does not depend on how often the odometer reports.
constexpr double kSegment_m = 0.02;
constexpr double kSegment_rad = 0.1;
constexpr double kStands_rad = 0.02;
// Resolution of odometer positions, about a millimetre. A segment's direction is uncertain by this value over its
// length. Turns before and after a segment's drive that are smaller than this uncertainty are not charged.
constexpr double kResolution_m = 2e-3;
constexpr Duration kMoment = std::chrono::milliseconds(300);  // time in which a robot's speed hardly changes

/// Whether the poses differ by more than the jitter of a robot that stands still.
bool has_moved(const Pose2& from, const Pose2& to) {
  return (to.position() - from.position()).norm() >= kSegment_m ||
         std::abs(wrap(to.heading_rad - from.heading_rad)) >= kStands_rad;
}

/// The control whose variances a segment is charged: an arc with the same total turn. Of the sideways direction, only
/// the part that the odometer's resolution does not explain is charged.
Control charged_for(const Control& control) {
  const double half_turn_rad = 0.5 * wrap(control.first_turn_rad + control.second_turn_rad);
  const double sideways_rad = wrap(control.first_turn_rad - half_turn_rad);
  const double length_m = std::abs(control.distance_m);
  const double excused_rad = length_m > 0.0 ? kResolution_m / length_m : kPi;
  const double excess_rad = std::copysign(std::max(0.0, std::abs(sideways_rad) - excused_rad), sideways_rad);
  return {control.distance_m, half_turn_rad + excess_rad, half_turn_rad - excess_rad};
}

/// The true motion when the odometer reports `raw`.
Control calibrated(const Control& raw, const OdometryRig& rig) {
  const double hand = rig.wheels_swapped ? -1.0 : 1.0;
  const double turn_rad = hand * (raw.first_turn_rad + raw.second_turn_rad);
  const double distance_m = rig.scale_distance * raw.distance_m;
  const double correction_rad = (rig.scale_turn - 1.0) * turn_rad + rig.drift_rad_per_m * distance_m;
  return {distance_m, hand * raw.first_turn_rad + 0.5 * correction_rad,
          hand * raw.second_turn_rad + 0.5 * correction_rad};
}

/// The odometer's velocity from `a` to `b`, in the body's frame at `b`: (m/s, m/s, rad/s).
template <class Node>
Eigen::Vector3d velocity(const Node& a, const Node& b) {
  return (inverse(b.T_odom_body) * a.T_odom_body).vector() / -to_seconds(b.stamp - a.stamp);
}

/// Rotates a velocity by `heading_rad`.
Eigen::Vector3d turned(double heading_rad, const Eigen::Vector3d& velocity) {
  return {std::cos(heading_rad) * velocity.x() - std::sin(heading_rad) * velocity.y(),
          std::sin(heading_rad) * velocity.x() + std::cos(heading_rad) * velocity.y(), velocity.z()};
}

}  // namespace

OdometryTrack::OdometryTrack(const OdometryRig& rig)
    : noise_{rig.lambda_distance_m, rig.lambda_rotation_rad, rig.lambda_drift_rad2_per_m,
             rig.sigma_lateral_m_per_sqrt_m},
      rig_(rig),
      clock_(rig),
      waiting_(kCapacity) {}

void OdometryTrack::add(const OdometryReading& reading) {
  Node node{clock_.instant_of(reading.stamp),
            {},
            reading.sigma_gap_m * reading.sigma_gap_m,
            reading.sigma_gap_rad * reading.sigma_gap_rad};
  if (newest_) {
    node.T_odom_body = newest_->T_odom_body;
    if (raw_->origin == reading.origin)
      node.T_odom_body =
          move(newest_->T_odom_body, calibrated(control_between(raw_->T_odom_body, reading.T_odom_body), rig_));
  }
  raw_ = reading;
  newest_ = node;
  if (!passed_) {
    passed_ = node;
    passed_reading_ = node.stamp;
    running_.segment_start = node.T_odom_body;
    return;
  }
  if (count_ == kCapacity) {
    pass(waiting_[first_]);
    first_ = index(1);
    --count_;
  }
  waiting_[index(count_++)] = node;
}

void OdometryTrack::go_on(const OdometrySince& since) {
  raw_ = since.reading;
  newest_ = passed_ = Node{since.reading.stamp + clock_.lag_at_first(), since.T_odom_body};
  passed_reading_ = passed_->stamp;
  running_ = {since.motion, since.T_odom_body};
}

std::optional<Stamp> OdometryTrack::first_from(Stamp stamp) const {
  if (passed_ && passed_->stamp >= stamp) return passed_->stamp;
  for (std::size_t i = 0; i < count_; ++i)
    if (waiting_[index(i)].stamp >= stamp) return waiting_[index(i)].stamp;
  return std::nullopt;
}

bool OdometryTrack::is_blind_at(Stamp stamp, Duration longest) const {
  const Node* before = passed_ ? &*passed_ : nullptr;
  for (std::size_t i = 0; before && i < count_; ++i) {
    const Node& after = waiting_[index(i)];
    if (after.stamp < stamp) {
      before = &after;
      continue;
    }
    const bool doubted = after.gap_variance_m2 > 0.0 || after.gap_variance_rad2 > 0.0;
    return (doubted || has_moved(before->T_odom_body, after.T_odom_body)) && after.stamp > stamp &&
           stamp > before->stamp && after.stamp - before->stamp > longest;
  }
  return false;
}

OdometryTrack::Step OdometryTrack::advance_to(Stamp stamp) {
  while (count_ > 0 && waiting_[first_].stamp <= stamp) {
    pass(waiting_[first_]);
    first_ = index(1);
    --count_;
  }
  Node end = *passed_;
  if (count_ > 0 && stamp > passed_->stamp) {
    Node& next = waiting_[first_];
    const double fraction = to_seconds(stamp - passed_->stamp) / to_seconds(next.stamp - passed_->stamp);
    end = {stamp, interpolate(passed_->T_odom_body, next.T_odom_body, fraction)};
    charge_gap(running_, next, fraction);
    next.gap_variance_m2 *= 1.0 - fraction;
    next.gap_variance_rad2 *= 1.0 - fraction;
    note_velocity(next);
  }
  close_segment(running_, end.T_odom_body);
  // An image is taken earlier than stamped, by the lag. It therefore shows neither the last part of this step's motion
  // nor, at the step's start, the last part of the motion before.
  const Eigen::Vector3d momentary = is_momentary_ ? velocity_ : Eigen::Vector3d::Zero();
  running_.motion.by_lag -= turned(running_.motion.T_start_end.heading_rad, momentary);
  running_.motion.velocity_at_end = velocity_;
  const Step step{running_.motion, end.T_odom_body};
  running_ = {Motion{}, end.T_odom_body};
  running_.motion.by_lag = momentary;
  passed_ = end;
  return step;
}

OdometryTrack::Step OdometryTrack::peek() const {
  Running running = running_;
  for (std::size_t i = 0; i < count_; ++i) {
    extend(running, waiting_[index(i)].T_odom_body);
    charge_gap(running, waiting_[index(i)], 1.0);
  }
  close_segment(running, newest_->T_odom_body);
  return {running.motion, newest_->T_odom_body};
}

void OdometryTrack::pass(const Node& node) {
  extend(running_, node.T_odom_body);
  charge_gap(running_, node, 1.0);
  note_velocity(node);
  passed_ = node;
  passed_reading_ = node.stamp;
}

/// Computes the velocity from passed_ to the reading after it. A mean over a long time does not give the velocity at
/// the end of this time: odometry noise would then look like the effect of a lag.
void OdometryTrack::note_velocity(const Node& next) {
  velocity_ = velocity(*passed_, next);
  is_momentary_ = next.stamp - passed_reading_ <= kMoment;
}

/// The error may lie anywhere within the gap, so its variance is spread evenly over the gap.
void OdometryTrack::charge_gap(Running& running, const Node& node, double fraction) {
  running.motion.covariance.diagonal() +=
      fraction * Eigen::Vector3d(node.gap_variance_m2, node.gap_variance_m2, node.gap_variance_rad2);
}

void OdometryTrack::extend(Running& running, const Pose2& T_odom_body) const {
  const Pose2& start = running.segment_start;
  const double length_m = hypotenuse(T_odom_body.x_m - start.x_m, T_odom_body.y_m - start.y_m);
  if (length_m >= kSegment_m || std::abs(wrap(T_odom_body.heading_rad - start.heading_rad)) >= kSegment_rad)
    close_segment(running, T_odom_body);
}

void OdometryTrack::close_segment(Running& running, const Pose2& T_odom_body) const {
  if (T_odom_body == running.segment_start) return;
  const Control control = control_between(running.segment_start, T_odom_body);
  append(running.motion, control, charged_for(control), noise_);
  running.segment_start = T_odom_body;
}

}  // namespace azimuth
