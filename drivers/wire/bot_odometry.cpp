#include "drivers/wire/bot_odometry.hpp"

#include <cmath>

#include "drivers/wire/messages.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

/// More than any wheeled robot does.
constexpr double kMaxSpeed_m_s = 20.0;
constexpr double kSlack_m = 0.5;
constexpr double kMaxNormError = 0.05;

/// The turn about the vertical of a quaternion (w, x, y, z); nothing for one that is none.
std::optional<double> heading_of(const double (&q)[4]) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(norm - 1.0) <= kMaxNormError)) return std::nullopt;
  return std::atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]));
}

}  // namespace

std::optional<OdometryReading> decode_bot_odometry(Bytes data) {
  const std::optional<pose_t> pose = decode_bot_pose(data);
  const std::optional<double> heading_rad = pose ? heading_of(pose->orientation) : std::nullopt;
  if (!heading_rad) return std::nullopt;
  const Pose2 T_odom_body{pose->pos[0], pose->pos[1], *heading_rad};
  if (!is_plausible(T_odom_body)) return std::nullopt;
  return OdometryReading{.stamp = stamp_from_us(pose->utime), .T_odom_body = T_odom_body};
}

bool is_restart(const OdometryReading& before, const OdometryReading& now) {
  const Pose2 &to = now.T_odom_body, &from = before.T_odom_body;
  const double rolled_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  return rolled_m > kSlack_m + kMaxSpeed_m_s * to_seconds(now.stamp - before.stamp);
}

void number_bot_odometry(std::span<OdometryReading> readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].sequence = i;
    if (i > 0) readings[i].origin = readings[i - 1].origin + (is_restart(readings[i - 1], readings[i]) ? 1 : 0);
  }
}

}  // namespace azimuth
