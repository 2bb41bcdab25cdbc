#include "drivers/pioneer/measured_motion.hpp"

#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth::pioneer {
namespace {

// 1023 counts correspond to 5 V, and 2.5 V to 300 deg/s, before the scale of the individual board.
constexpr double kDegreesPerSecondAndCount = 5.0 / 1023.0 * 300.0 / 2.5;

constexpr int kRestSamples = 25;
constexpr double kRest_s = 1.0;
constexpr double kLongRest_s = 30.0;  // then a new mean is started, because the rate at rest drifts with temperature
constexpr double kLeastCoverage = 0.75, kMostCoverage = 1.5;

// Standard deviation of the wheels' turn. It is proportional to the turn, because turning wheels slip sideways, and
// very small on a straight line.
constexpr double kWheelsPerTurn = 0.03, kWheels_rad_per_s = degrees_to_rad(0.1);
// Standard deviation of the gyro's turn. Its scale is accurate; its rate at rest has an error of a fraction of the
// coarse resolution.
constexpr double kGyroPerTurn = 0.01, kGyro_rad_per_s = degrees_to_rad(0.3);

constexpr double kSkid_rad = degrees_to_rad(2.0), kSkidPerTurn = 0.2;

double square(double x) { return x * x; }

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

GyroTurn::GyroTurn(double scale) : rad_per_count_(degrees_to_rad(kDegreesPerSecondAndCount * scale)) {}

void GyroTurn::add(const GyroPacket& packet) {
  for (const auto& sample : packet.all()) {
    sum_ += sample.rate;
    new_sum_ += sample.rate;
    ++count_;
    ++new_count_;
  }
}

void GyroTurn::note_standing(bool standing, double elapsed_s) {
  if (!standing || rest_s_ > kLongRest_s) {
    rest_sum_ = rest_s_ = 0.0;
    rest_count_ = 0;
  }
  if (standing) {
    rest_sum_ += new_sum_;
    rest_count_ += new_count_;
    rest_s_ += elapsed_s;
    if (rest_count_ > kRestSamples && rest_s_ > kRest_s) rate_at_rest_ = rest_sum_ / rest_count_;
  }
  new_sum_ = 0.0;
  new_count_ = 0;
}

std::optional<double> GyroTurn::take_rad(double elapsed_s) {
  const double covered_s = count_ * kGyroSamplePeriod_s;
  const bool complete = covered_s >= kLeastCoverage * elapsed_s && covered_s <= kMostCoverage * elapsed_s;
  std::optional<double> turn_rad;
  // Uses the time covered by the samples, because a sample that arrives in the next cycle counts there.
  if (rate_at_rest_ && complete && count_ > 0)
    turn_rad = -(sum_ / count_ - *rate_at_rest_) * rad_per_count_ * covered_s;
  sum_ = 0.0;
  count_ = 0;
  return turn_rad;
}

FusedTurn fuse_turns(double wheels_rad, double gyro_rad, double elapsed_s) {
  if (std::abs(gyro_rad - wheels_rad) > kSkid_rad + kSkidPerTurn * std::abs(wheels_rad)) return {gyro_rad, true};
  if (wheels_rad == 0.0) return {};  // wheels at rest are trusted more than a drifting gyro
  const double wheels_variance = square(kWheelsPerTurn * wheels_rad) + square(kWheels_rad_per_s * elapsed_s);
  const double gyro_variance = square(kGyroPerTurn * gyro_rad) + square(kGyro_rad_per_s * elapsed_s);
  const double gyro_weight = wheels_variance / (wheels_variance + gyro_variance);
  return {wheels_rad + gyro_weight * (gyro_rad - wheels_rad), false};
}

}  // namespace azimuth::pioneer
