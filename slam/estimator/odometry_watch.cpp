#include "slam/estimator/odometry_watch.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// Window length: long enough for jittering stamps and for readings that arrive in small bursts.
constexpr Duration kWindow{500'000};
/// Limits that no wheeled robot reaches; millimetres taken for metres, or degrees for radians, exceed them by far.
constexpr double kMaxSpeed_m_s = 20.0, kMaxTurn_rad_s = 10.0;
constexpr int kWindows = 8, kFewWindows = 3;
/// Weight of the past when a window is added: an effective memory of about forty windows.
constexpr double kKept = 0.975;
/// Length of a mean of unit vectors: above kAgree the directions agree, below kDisagree they do not.
constexpr double kAgree = 0.9, kDisagree = 0.6;

/// Whether several windows exceed the limit, or most of the windows if there are few; one jump is not enough.
bool is_sure(const Recent& too_fast) { return too_fast.held() >= kWindows || too_fast.mostly(); }
bool is_larger(const OdometryJump& a, const OdometryJump& b) {
  return a.step_m > b.step_m || (a.step_m == b.step_m && a.step_rad > b.step_rad);
}
std::complex<double> doubled(double angle_rad) { return std::polar(1.0, 2.0 * angle_rad); }

}  // namespace

void OdometryWatch::add(const OdometryReading& reading) {
  OdometryReading calibrated = reading;
  calibrated.T_odom_body.x_m *= rig_.scale_distance;
  calibrated.T_odom_body.y_m *= rig_.scale_distance;
  if (const std::optional<OdometryJump> jump = steps_.next(calibrated))
    if (steps_.jumps() == 1 || is_larger(*jump, largest_jump_)) largest_jump_ = *jump;
  const bool goes_on =
      window_ && reading.origin == window_->last.origin && reading.sigma_gap_m == 0.0 && reading.sigma_gap_rad == 0.0;
  if (!goes_on) {
    window_ = Window{reading, reading};
    return;
  }
  const double turned_rad = wrap(reading.T_odom_body.heading_rad - window_->last.T_odom_body.heading_rad);
  window_->heading_rad += turned_rad;
  window_->turned_rad += std::abs(turned_rad);
  window_->last = reading;
  if (reading.stamp - window_->start.stamp < kWindow) return;
  judge(*window_);
  const double heading_rad = window_->heading_rad;
  window_ = Window{reading, reading, heading_rad, heading_rad};
}

void OdometryWatch::judge(const Window& window) {
  const Eigen::Vector2d driven = window.last.T_odom_body.position() - window.start.T_odom_body.position();
  const double seconds = to_seconds(window.last.stamp - window.start.stamp);
  const double speed_m_s = rig_.scale_distance * driven.norm() / seconds;
  const double turn_rad_s = rig_.scale_turn * window.turned_rad / seconds;
  if (speed_m_s == 0.0 && turn_rad_s == 0.0) return;
  driven_too_fast_.add(speed_m_s > kMaxSpeed_m_s);
  turned_too_fast_.add(turn_rad_s > kMaxTurn_rad_s);
  fastest_m_s_ = std::max(fastest_m_s_, speed_m_s);
  fastest_rad_s_ = std::max(fastest_rad_s_, turn_rad_s);
  if (speed_m_s > 0.0)
    judge_direction(std::atan2(driven.y(), driven.x()), 0.5 * (window.heading_at_start_rad + window.heading_rad));
}

void OdometryWatch::judge_direction(double direction_rad, double heading_rad) {
  ++moves_;
  directions_count_ = kKept * directions_count_ + 1.0;
  directions_ = kKept * directions_ + doubled(direction_rad);
  off_heading_ = kKept * off_heading_ + doubled(direction_rad - heading_rad);
  off_heading_in_degrees_ = kKept * off_heading_in_degrees_ + doubled(direction_rad - degrees_to_rad(heading_rad));
}

/// Whether motion follows the heading only if the heading is read as degrees. A drive in a single direction proves
/// nothing.
bool OdometryWatch::fits_degrees() const {
  if (moves_ < kWindows) return false;
  const auto agreement = [this](const std::complex<double>& sum) { return std::abs(sum) / directions_count_; };
  return agreement(directions_) < kDisagree && agreement(off_heading_) < kDisagree &&
         agreement(off_heading_in_degrees_) > kAgree;
}

OdometryDoubt OdometryWatch::doubt(bool few) const {
  const OdometryDoubt by_steps = steps_.are_frequent() ? OdometryDoubt::jumps : OdometryDoubt::none;
  if (driven_too_fast_.asked() < (few ? kFewWindows : kWindows)) return few ? by_steps : OdometryDoubt::none;
  const bool drives = is_sure(driven_too_fast_), turns = is_sure(turned_too_fast_);
  if (drives && turns) return OdometryDoubt::too_quick;
  if (turns || fits_degrees()) return OdometryDoubt::heading_in_degrees;
  return drives ? OdometryDoubt::too_fast : by_steps;
}

}  // namespace azimuth
