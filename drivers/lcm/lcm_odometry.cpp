#include "drivers/lcm/lcm_odometry.hpp"

#include <cmath>
#include <optional>

#include "drivers/io/messages.hpp"
#include "drivers/io/plausible.hpp"

namespace azimuth {
namespace {

/// More than any wheeled robot does; such a step is a restart that nobody announced.
constexpr double kMaxSpeed_m_s = 20.0;
constexpr double kSlack_m = 0.5;
/// A gap beyond this is a restart as well.
constexpr std::uint64_t kMaxGap = 100'000;
constexpr double kMaxNormError = 0.05;

/// The turn about the vertical of a quaternion (w, x, y, z); nothing for one that is none.
std::optional<double> heading_of(const double (&q)[4]) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(norm - 1.0) <= kMaxNormError)) return std::nullopt;
  return std::atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]));
}

Duration seconds(double seconds) { return duration_from_seconds(seconds); }

}  // namespace

LcmOdometry::LcmOdometry(const LcmSourceSettings& settings)
    : channel_(settings.odometry_channel),
      senders_(seconds(settings.silent_s)),
      stamps_(settings.stamps, seconds(settings.max_age_s)) {}

void LcmOdometry::accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) {
  if (packet.parts != 1 || packet.channel != channel_) return;
  if (!senders_.would_accept(sender, receipt.stamp)) {
    ++counts_.other_senders;
    return;
  }
  Said said;
  if (!decode(packet.payload, said)) {
    ++counts_.malformed;
    return;
  }
  const std::optional<Stamp> stamp = stamps_.judge(said.reading.stamp, receipt);
  if (!stamp) return;
  said.reading.stamp = *stamp;
  follow(said, senders_.heard(sender, receipt.stamp));
}

bool LcmOdometry::decode(Bytes message, Said& said) {
  if (const std::optional<OdometryReading> reading = decode_odometry(message)) {
    said = {*reading, false};
    return true;
  }
  const std::optional<pose_t> pose = decode_bot_pose(message);
  const std::optional<double> heading_rad = pose ? heading_of(pose->orientation) : std::nullopt;
  if (!heading_rad) return false;
  said = {{.stamp = stamp_from_us(pose->utime), .T_odom_body = {pose->pos[0], pose->pos[1], *heading_rad}}, true};
  return is_plausible(said.reading.T_odom_body);
}

void LcmOdometry::follow(const Said& said, bool is_new_sender) {
  const std::uint64_t step = said.reading.sequence - last_said_.reading.sequence;
  const bool counted = !said.is_bot_pose && step != 0;  // some senders never count
  std::uint64_t missing = 0;
  if (is_new_sender || begins_anew(said) || (counted && step > kMaxGap)) {
    ++counts_.origins;
  } else if (counted) {
    missing = step - 1;
  }
  counts_.missing += missing;
  const std::uint64_t sequence = reading_.sequence + 1 + missing;
  reading_ = said.reading;
  reading_.sequence = sequence;
  reading_.origin = static_cast<std::uint32_t>(counts_.origins);
  last_said_ = said;
  ++counts_.readings;
  if (!readings_.push(reading_)) ++counts_.replaced;
}

/// Of the same sender.
bool LcmOdometry::begins_anew(const Said& said) const {
  const OdometryReading &now = said.reading, &before = last_said_.reading;
  if (said.is_bot_pose != last_said_.is_bot_pose || now.origin != before.origin) return true;
  const Pose2 &to = now.T_odom_body, &from = before.T_odom_body;
  const double rolled_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  return rolled_m > kSlack_m + kMaxSpeed_m_s * to_seconds(now.stamp - before.stamp);
}

}  // namespace azimuth
