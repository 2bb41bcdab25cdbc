// Computes the next reading from the motion since the last one.

#include <algorithm>
#include <cmath>

#include "drivers/device/device_clock.hpp"
#include "drivers/pioneer/odometer.hpp"
#include "drivers/pioneer/rotated.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth::pioneer {
namespace {

constexpr double kSkidDoubt = 0.25;  // standard deviation per disagreement of gyro and wheels

}  // namespace

OdometryReading Odometer::emit(const std::optional<TickMotion>& ticks) {
  const double turn_rad = turn_since_last(ticks);
  // The chord of the SIP, rotated by half the correction of the turn; or the chord of the arc given by the ticks.
  Eigen::Vector2d p_body = rotated(since_.T_last_body.position(), 0.5 * (turn_rad - since_.turn_rad));
  if (ticks) {
    const double half_rad = 0.5 * turn_rad;
    const double chord = half_rad == 0.0 ? 1.0 : std::sin(half_rad) / half_rad;
    p_body = rotated({ticks->distance_m * chord, 0.0}, half_rad);
  }
  T_odom_body_ = T_odom_body_ * Pose2{p_body.x(), p_body.y(), wrap(turn_rad)};
  if (since_.elapsed_s > 0.0) {
    speed_m_s_ = since_.forward_m / since_.elapsed_s;
    turn_rad_s_ = turn_rad / since_.elapsed_s;
  }
  return reading();
}

double Odometer::turn_since_last(const std::optional<TickMotion>& ticks) {
  const double wheels_rad = ticks && ticks->turn_rad ? *ticks->turn_rad : since_.turn_rad;
  if (!gyro_) return wheels_rad;
  const auto gyro_rad = gyro_->take_rad(since_.elapsed_s);
  const FusedTurn fused =
      gyro_rad ? fuse_turns(wheels_rad, *gyro_rad, since_.elapsed_s) : FusedTurn{.turn_rad = wheels_rad};
  gyro_->note_standing(since_.standing && !fused.skid, since_.elapsed_s);
  if (fused.skid) {
    ++counts_.skids;
    add_sigma(std::abs(since_.forward_m), kSkidDoubt * std::abs(*gyro_rad - wheels_rad));
  }
  return fused.turn_rad;
}

OdometryReading Odometer::reading() {
  OdometryReading reading = order_.next(stamp_at(last_->at - usb_latency_, epoch_minus_monotonic_));
  reading.origin = origin_;
  reading.T_odom_body = T_odom_body_;
  reading.sigma_gap_m = since_.sigma_m;
  reading.sigma_gap_rad = since_.sigma_rad;
  if (since_.sigma_m > 0.0 || since_.sigma_rad > 0.0) ++counts_.gaps;
  since_ = {};
  return reading;
}

}  // namespace azimuth::pioneer
