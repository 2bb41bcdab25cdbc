#include "slam/sample/odometry_steps.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

/// Bounds that no wheeled robot exceeds, independent of its previous speed.
constexpr double kMaxSpeed_m_s = 20.0, kMaxSlack_m = 0.5;
// Bounds on a step of wheels without slip, relative to the previous speed, and on the delay of stamps taken at arrival.
constexpr double kSlack_m = 0.1, kSlack_rad = 0.25;
constexpr double kMayAccelerate_m_s2 = 10.0, kMayAccelerate_rad_s2 = 20.0;
constexpr double kLate_s = 0.3;
// Bounds for a step to zero. An odometer that is read for the first time may have moved a little since its start.
constexpr double kZero_m = 0.02, kZero_rad = 0.02, kMostZero_m = 0.1, kMostZero_rad = 0.1;
constexpr double kZeroSlack_m = 0.03, kZeroSlack_rad = 0.05;
constexpr double kZeroLate_s = 0.05;
constexpr double kZeroAccelerate_m_s2 = 2.0, kZeroAccelerate_rad_s2 = 5.0;
/// An odometer that reads exactly zero after an unusually long pause has restarted.
constexpr double kPause_s = 1.0, kUnusual = 5.0, kApart_m = 0.1, kApart_rad = 0.1;

constexpr double kStretch_s = 0.2;
/// Uncertainty of the motion during a jump. Over a short gap the robot kept its speed; over a longer gap, a usual
/// indoor speed is assumed.
constexpr double kShort_s = 0.5, kIndoor_m_s = 1.0, kIndoor_rad_s = 1.0, kLeast_m = 0.005, kLeast_rad = 0.005;
constexpr double kBegins_m_s2 = 1.0, kBegins_rad_s2 = 2.0;

double distance_m(const Pose2& a, const Pose2& b) { return hypotenuse(b.x_m - a.x_m, b.y_m - a.y_m); }
double turn_rad(const Pose2& a, const Pose2& b) { return std::abs(wrap(b.heading_rad - a.heading_rad)); }

}  // namespace

std::optional<OdometryJump> OdometrySteps::next(const OdometryReading& reading) {
  const bool goes_on = last_ && last_->origin == reading.origin && reading.stamp > last_->stamp &&
                       reading.sigma_gap_m == 0.0 && reading.sigma_gap_rad == 0.0;
  std::optional<OdometryJump> jump;
  if (goes_on) {
    jump = judge(reading);
    ++steps_;
    jumps_ += jump ? 1 : 0;
    measure(reading, jump.has_value());
  }
  last_ = reading;
  return jump;
}

/// The medians of translational and rotational speed.
OdometrySteps::Speed OdometrySteps::usual_speed() const {
  const std::size_t count = std::min(stretches_, speeds_.size());
  if (count == 0) return {};
  const auto median = [&](double Speed::*part) {
    std::array<double, std::tuple_size_v<decltype(speeds_)>> sorted{};
    for (std::size_t i = 0; i < count; ++i) sorted[i] = speeds_[i].*part;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
    return sorted[(count - 1) / 2];
  };
  return {median(&Speed::m_s), median(&Speed::rad_s)};
}

std::optional<OdometryJump> OdometrySteps::judge(const OdometryReading& reading) const {
  const double elapsed_s = to_seconds(reading.stamp - last_->stamp);
  const double step_m = distance_m(last_->T_odom_body, reading.T_odom_body);
  const double step_rad = turn_rad(last_->T_odom_body, reading.T_odom_body);
  const Speed speed = usual_speed();
  double reach_m = kMaxSlack_m + kMaxSpeed_m_s * elapsed_s, reach_rad = kPi;
  if (stretches_ > 0) {
    reach_m =
        std::min(reach_m, kSlack_m + speed.m_s * (elapsed_s + kLate_s) + kMayAccelerate_m_s2 * elapsed_s * elapsed_s);
    reach_rad = kSlack_rad + speed.rad_s * (elapsed_s + kLate_s) + kMayAccelerate_rad_s2 * elapsed_s * elapsed_s;
  }
  if (step_m <= reach_m && step_rad <= reach_rad && !goes_to_zero(reading, elapsed_s)) return std::nullopt;
  return jump(reading);
}

/// Assumes the highest recent speed, plus what a robot can gain by accelerating during the step.
OdometryJump OdometrySteps::jump(const OdometryReading& reading) const {
  Speed fastest;
  for (const Speed& speed : speeds_) fastest = {std::max(fastest.m_s, speed.m_s), std::max(fastest.rad_s, speed.rad_s)};
  const double elapsed_s = to_seconds(reading.stamp - last_->stamp);
  if (elapsed_s > kShort_s) fastest = {std::max(fastest.m_s, kIndoor_m_s), std::max(fastest.rad_s, kIndoor_rad_s)};
  const double begun_s2 = 0.5 * elapsed_s * std::min(elapsed_s, kShort_s);
  return {.stamp = reading.stamp,
          .step_m = distance_m(last_->T_odom_body, reading.T_odom_body),
          .step_rad = turn_rad(last_->T_odom_body, reading.T_odom_body),
          .sigma_m = kLeast_m + fastest.m_s * elapsed_s + kBegins_m_s2 * begun_s2,
          .sigma_rad = std::min(kPi, kLeast_rad + fastest.rad_s * elapsed_s + kBegins_rad_s2 * begun_s2)};
}

bool OdometrySteps::goes_to_zero(const OdometryReading& reading, double elapsed_s) const {
  const Pose2 &to = reading.T_odom_body, &from = last_->T_odom_body;
  const double step_m = distance_m(from, to), step_rad = turn_rad(from, to);
  const bool is_exact = to.x_m == 0.0 && to.y_m == 0.0 && to.heading_rad == 0.0;
  const bool is_after_pause = elapsed_s > kPause_s && elapsed_s > kUnusual * usual_s_;
  if (is_exact && is_after_pause && (step_m > kApart_m || step_rad > kApart_rad)) return true;
  if (stretches_ == 0) return false;
  const auto [m_s, rad_s] = usual_speed();
  const bool is_zero = distance_m({}, to) <= std::min(kMostZero_m, kZero_m + m_s * elapsed_s) &&
                       std::abs(to.heading_rad) <= std::min(kMostZero_rad, kZero_rad + rad_s * elapsed_s);
  const double room_s = 1.5 * elapsed_s + kZeroLate_s, square_s2 = elapsed_s * elapsed_s;
  return is_zero && (step_m > kZeroSlack_m + m_s * room_s + kZeroAccelerate_m_s2 * square_s2 ||
                     step_rad > kZeroSlack_rad + rad_s * room_s + kZeroAccelerate_rad_s2 * square_s2);
}

void OdometrySteps::measure(const OdometryReading& reading, bool is_jump) {
  const double elapsed_s = to_seconds(reading.stamp - last_->stamp);
  usual_s_ = usual_s_ == 0.0 ? elapsed_s : 0.9 * usual_s_ + 0.1 * elapsed_s;
  if (is_jump && !are_frequent()) return;
  stretch_s_ += elapsed_s;
  stretch_m_ += distance_m(last_->T_odom_body, reading.T_odom_body);
  stretch_rad_ += turn_rad(last_->T_odom_body, reading.T_odom_body);
  if (stretch_s_ < kStretch_s) return;
  speeds_[stretches_++ % speeds_.size()] = {stretch_m_ / stretch_s_, stretch_rad_ / stretch_s_};
  stretch_s_ = stretch_m_ = stretch_rad_ = 0.0;
}

std::vector<OdometryJump> part_at_jumps(std::span<OdometryReading> readings) {
  OdometrySteps steps;
  std::vector<OdometryJump> jumps;
  for (const OdometryReading& reading : readings)
    if (const std::optional<OdometryJump> jump = steps.next(reading)) jumps.push_back(*jump);
  if (steps.are_frequent()) return {};
  auto jump = jumps.begin();
  std::uint32_t further = 0;
  for (OdometryReading& reading : readings) {
    if (jump != jumps.end() && reading.stamp == jump->stamp) {
      ++further;
      reading.sigma_gap_m = jump->sigma_m;
      reading.sigma_gap_rad = jump->sigma_rad;
      ++jump;
    }
    reading.origin += further;
  }
  return jumps;
}

}  // namespace azimuth
