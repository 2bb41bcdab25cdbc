#include "sim/azimuth_sim/rover.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth::sim {
namespace {

constexpr double kTick_s = 0.01;

WheelMotion operator+(const WheelMotion& a, const WheelMotion& b) {
  return {a.left_m + b.left_m, a.right_m + b.right_m, a.body_turn_rad + b.body_turn_rad};
}
WheelMotion operator*(double factor, const WheelMotion& motion) {
  return {factor * motion.left_m, factor * motion.right_m, factor * motion.body_turn_rad};
}
WheelMotion operator-(const WheelMotion& a, const WheelMotion& b) { return a + -1.0 * b; }

double own_speed_m_per_s(const DriveSettings& drive) {
  if (const auto* steps = std::get_if<StepDrive>(&drive)) return steps->step_m / steps->period_s;
  return std::get<SmoothDrive>(drive).speed_m_per_s;
}

/// The wheel motion for a control that the odometer reports.
WheelMotion wheels_for(const Control& by_wheels, double track_m, double body_turn_rad) {
  const double half_m = (by_wheels.first_turn_rad + by_wheels.second_turn_rad) * track_m / 2;
  return {by_wheels.distance_m - half_m, by_wheels.distance_m + half_m, body_turn_rad};
}

Control control_for(const Twist& twist, double passed_s) {
  const double turn_rad = twist.turn_rate_rad_per_s * passed_s;
  return {twist.speed_m_per_s * passed_s, turn_rad / 2, turn_rad / 2};
}

}  // namespace

Rover::Rover(const Scenario& scenario, double track_m, LeftAlone left_alone)
    : drive_(scenario.drive),
      odometer_(scenario.odometer),
      track_m_(track_m),
      left_alone_(left_alone),
      driver_(make_driver(scenario.drive, scenario.path, Random(scenario.seed, RandomPurpose::drive))),
      random_(scenario.seed, RandomPurpose::odometry),
      tick_(duration_from_seconds(std::min(kTick_s, tick_s(scenario.drive)))),
      segment_tick_(tick_) {
  segment_.T_world_start = driver_->start();
}

void Rover::hurry(double speed_m_per_s) {
  const double pace = speed_m_per_s > 0.0 ? speed_m_per_s / own_speed_m_per_s(drive_) : 1.0;
  segment_tick_ = std::max(Duration(1), duration_from_seconds(to_seconds(tick_) / pace));
}

WheelMotion Rover::roll_to(Stamp until) {
  continue_to(until);
  const WheelMotion rolled_now = rolled(until);
  const WheelMotion since = rolled_now - rolled_taken_;
  rolled_taken_ = rolled_now;
  return since;
}

WheelMotion Rover::rolled_by(Stamp now) {
  continue_to(now);
  return rolled(now);
}

Pose2 Rover::pose_in_world(Stamp now) {
  continue_to(now);
  return segment_.T_world_start * interpolate(Pose2{}, segment_.T_start_end, fraction(now));
}

Pose2 Rover::pose_in_odom(Stamp now) {
  continue_to(now);
  return segment_.T_odom_start * interpolate(Pose2{}, segment_.T_start_end_by_wheels, fraction(now));
}

double Rover::fraction(Stamp now) const {
  if (segment_.end == segment_.start) return 0.0;
  return to_seconds(now - segment_.start) / to_seconds(segment_.end - segment_.start);
}

WheelMotion Rover::rolled(Stamp now) const { return rolled_before_ + fraction(now) * segment_.motion; }

void Rover::continue_to(Stamp until) {
  while (segment_.end <= until) begin_segment();
}

void Rover::begin_segment() {
  rolled_before_ = rolled_before_ + segment_.motion;
  Segment next;
  next.start = segment_.end;
  next.end = next.start + (ordered_ ? tick_ : segment_tick_);
  next.T_world_start = segment_.T_world_start * segment_.T_start_end;
  next.T_odom_start = segment_.T_odom_start * segment_.T_start_end_by_wheels;
  segment_ = next;

  const Control control = next_control();
  segment_.T_start_end = disturbed(control, odometer_, random_);
  const Control by_wheels = raw(control, odometer_);
  segment_.T_start_end_by_wheels = displacement(by_wheels);
  segment_.motion = wheels_for(by_wheels, track_m_, segment_.T_start_end.heading_rad);
}

Control Rover::next_control() {
  if (ordered_) {
    plan_.clear();  // Makes the driver start afresh from the robot's pose afterwards
    return control_for(*ordered_, to_seconds(tick_));
  }
  if (left_alone_ == LeftAlone::stands) return {};
  if (plan_.empty() && !arrived_) {
    const std::optional<Control> control = driver_->next(segment_.T_world_start);
    arrived_ = !control;
    if (control) plan(*control);
  }
  if (plan_.empty()) return {};
  const Control control = plan_.front();
  plan_.pop_front();
  return control;
}

/// Splits a stop-and-go control into ticks that turn, ticks that drive and ticks that turn.
void Rover::plan(const Control& control) {
  const auto ticks = static_cast<int>(std::lround(tick_s(drive_) / to_seconds(tick_)));
  if (ticks < 4) return plan_.push_back(control);
  const int turning = ticks / 4, driving = ticks - 2 * turning;
  plan_.insert(plan_.end(), static_cast<std::size_t>(turning), {0.0, control.first_turn_rad / turning, 0.0});
  plan_.insert(plan_.end(), static_cast<std::size_t>(driving), {control.distance_m / driving, 0.0, 0.0});
  plan_.insert(plan_.end(), static_cast<std::size_t>(turning), {0.0, 0.0, control.second_turn_rad / turning});
}

}  // namespace azimuth::sim
