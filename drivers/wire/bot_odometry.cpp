#include "drivers/wire/bot_odometry.hpp"

#include <cmath>

#include "drivers/wire/messages.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

constexpr double kMaxNormError = 0.05;

/// The rotation about the vertical of a quaternion (w, x, y, z); none when it is not a unit quaternion.
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

std::vector<OdometryJump> number_odometry(std::span<OdometryReading> readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i].sequence = i;
  return part_at_jumps(readings);
}

}  // namespace azimuth
