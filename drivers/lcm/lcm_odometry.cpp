#include "drivers/lcm/lcm_odometry.hpp"

#include <optional>

#include "drivers/io/bot_odometry.hpp"
#include "drivers/io/messages.hpp"

namespace azimuth {
namespace {

/// A gap beyond this is a restart as well.
constexpr std::uint64_t kMaxGap = 100'000;

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
  const std::optional<OdometryReading> pose = decode_bot_odometry(message);
  if (pose) said = {*pose, true};
  return pose.has_value();
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
  return is_restart(before, now);
}

}  // namespace azimuth
