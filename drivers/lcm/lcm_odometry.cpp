#include "drivers/lcm/lcm_odometry.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "drivers/wire/bot_odometry.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

/// A gap in the sequence numbers larger than this counts as a restart.
constexpr std::uint64_t kMaxGap = 100'000;

// Standard deviation per metre and radian of the motion while the odometry was not received.
constexpr double kHiddenPath = 0.05;
constexpr double kIndoorSpeed_m_s = 1.0, kIndoorTurn_rad_s = 1.0;

constexpr std::string_view kOdometer = "lcm ";
constexpr std::size_t kSender = 0, kIsBotPose = 1, kSequence = 2, kOrigin = 3;  // indices in OdometerMemory::numbers

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
  const bool counted = !said.is_bot_pose && step != 0;  // some senders do not count
  const bool unheard = std::exchange(restored_, false);
  const Duration silence = said.reading.stamp - last_said_.reading.stamp;
  std::uint64_t missing = 0;
  if (is_new_sender) steps_ = OdometrySteps();
  const std::optional<OdometryJump> jump = steps_.next(said.reading);
  const bool jumps = jump && !steps_.are_frequent();
  const bool anew = is_new_sender || begins_anew(said) || jumps || (counted && !unheard && step > kMaxGap);
  if (anew) {
    ++counts_.origins;
    ++origin_;
  } else if (counted && !unheard) {
    missing = step - 1;
  }
  counts_.missing += missing;
  const std::uint64_t sequence = reading_.sequence + 1 + missing;
  reading_ = said.reading;
  reading_.sequence = sequence;
  reading_.origin = origin_;
  if (unheard && !anew) charge_silence(silence);
  if (jumps) {
    reading_.sigma_gap_m = std::hypot(reading_.sigma_gap_m, jump->sigma_m);
    reading_.sigma_gap_rad = std::hypot(reading_.sigma_gap_rad, jump->sigma_rad);
  }
  last_said_ = said;
  ++counts_.readings;
  if (!readings_.push(reading_)) ++counts_.replaced;
}

/// Adds the uncertainty of a silence: the sender knows the pose that the robot reached, but not its path.
void LcmOdometry::charge_silence(Duration silence) {
  const double hidden_s = kHiddenPath * to_seconds(silence);
  reading_.sigma_gap_m = std::hypot(reading_.sigma_gap_m, kIndoorSpeed_m_s * hidden_s);
  reading_.sigma_gap_rad = std::hypot(reading_.sigma_gap_rad, kIndoorTurn_rad_s * hidden_s);
}

bool LcmOdometry::remember(OdometerMemory& out) const {
  if (counts_.readings == 0 && !restored_) return false;
  const OdometryReading& said = last_said_.reading;
  out.odometer.assign(kOdometer).append(channel_);
  out.robot.clear();
  out.origin = origin_;
  out.at = said.stamp;
  out.T_odom_body = said.T_odom_body;
  out.numbers = {};
  out.numbers[kSender] = senders_.sender();
  out.numbers[kIsBotPose] = last_said_.is_bot_pose ? 1 : 0;
  out.numbers[kSequence] = said.sequence;
  out.numbers[kOrigin] = said.origin;
  return true;
}

void LcmOdometry::restore(const OdometerMemory& memory) {
  origin_ = memory.origin;
  const bool is_ours = memory.odometer.starts_with(kOdometer) && memory.odometer.substr(kOdometer.size()) == channel_;
  if (!is_ours) return;
  senders_.resume(memory.numbers[kSender], memory.at);
  last_said_ = {{.stamp = memory.at,
                 .sequence = memory.numbers[kSequence],
                 .origin = static_cast<std::uint32_t>(memory.numbers[kOrigin]),
                 .T_odom_body = memory.T_odom_body},
                memory.numbers[kIsBotPose] != 0};
  steps_.next(last_said_.reading);
  restored_ = true;
}

/// True: the same sender announces a new origin.
bool LcmOdometry::begins_anew(const Said& said) const {
  const OdometryReading &now = said.reading, &before = last_said_.reading;
  return said.is_bot_pose != last_said_.is_bot_pose || now.origin != before.origin;
}

}  // namespace azimuth
