#include "drivers/pioneer/wheel_ticks.hpp"

#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth::pioneer {
namespace {

constexpr double kStretch_m = 0.3;  // path length over which ticks and SIP are compared
constexpr double kAgreement =
    0.03;  // largest difference as a share of the path; the firmware rounds its own conversion
constexpr double kAgreement_m = 0.008;  // added to the largest difference, for whole millimetres at both ends
constexpr double kStepAgreement = 0.25, kStepAgreement_m = 0.015;

/// The counters wrap modulo 2^32.
double difference(std::int32_t newer, std::int32_t older) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(newer) - static_cast<std::uint32_t>(older));
}

}  // namespace

std::optional<TickMotion> WheelTicks::advance(const EncoderPacket& packet, double sip_forward_m) {
  const auto before = std::exchange(last_, packet);
  if (!before || per_mm_ <= 0.0) return std::nullopt;
  const double left = difference(packet.left_ticks, before->left_ticks);
  const double right = difference(packet.right_ticks, before->right_ticks);
  TickMotion motion{.distance_m = 1e-3 * 0.5 * (left + right) / per_mm_, .turn_rad = {}};
  if (per_turn_ > 0.0) motion.turn_rad = 2.0 * kPi * (right - left) / per_turn_;
  compare(motion.distance_m, sip_forward_m);
  const double apart_m = std::abs(motion.distance_m - sip_forward_m);
  if (apart_m > kStepAgreement * std::abs(sip_forward_m) + kStepAgreement_m) return std::nullopt;
  return motion;
}

/// Compares path lengths, so that driving back and forth counts as one stretch.
void WheelTicks::compare(double ticks_m, double sip_m) {
  ticks_m_ += std::copysign(1.0, sip_m) * ticks_m;
  sip_m_ += std::abs(sip_m);
  path_m_ += std::max(std::abs(sip_m), std::abs(ticks_m));
  if (path_m_ < kStretch_m) return;
  trusted_ = std::abs(ticks_m_ - sip_m_) <= kAgreement * path_m_ + kAgreement_m;
  ticks_m_ = sip_m_ = path_m_ = 0.0;
}

}  // namespace azimuth::pioneer
