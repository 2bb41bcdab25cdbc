#include "drivers/pioneer/odometer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/device/device_clock.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth::pioneer {
namespace {

Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle_rad) { return Pose2{0.0, 0.0, angle_rad} * v; }

constexpr double kSkidDoubt = 0.25;  // standard deviation per disagreement of gyro and wheels

constexpr double kCounterRange_units = 32768.0;
constexpr double kFasterThanPossible = 1.5;  // multiple of the robot's limits beyond which a step is not trusted
constexpr double kRounding_units = 2.0;
constexpr double kHiddenPath = 0.05;  // standard deviation per metre or radian of a path between two distant SIPs
constexpr int kTicksStopped = 3;      // consecutive SIPs without ticks
constexpr double kOneCycle = 1.5;     // largest number of cycle times that counts as one cycle
constexpr double kStraight_units = 2.0;

// While no session is open, the robot may continue to drive or start to turn until its firmware stops it for lack of
// commands. It may also have been pushed.
constexpr double kLongestDrive_s = 5.0;
constexpr double kIndoorTurn_rad_s = 1.0;  // robots indoors turn by up to this rate
constexpr double kMayTurn_rad_s = 0.45;    // standard deviation of the turn rate
constexpr double kPushed_m = 0.05, kPushed_rad = 0.05;

/// Difference of two position counters, of which 15 bits are reliable. After an implausible step of `jump_units` the
/// counter may jump back by the same amount. Near half the range the shortest way would then continue in the wrong
/// direction, so the other way is considered as well.
double counter_step(std::uint16_t newer, std::uint16_t older, double jump_units) {
  const auto difference = static_cast<unsigned>(newer - older) & 0x7FFFU;
  const double shortest = difference < 0x4000U ? difference : difference - kCounterRange_units;
  const double other = shortest - std::copysign(kCounterRange_units, shortest);
  const bool comes_back = std::abs(other + jump_units) < std::min(std::abs(shortest), std::abs(shortest + jump_units));
  return comes_back ? other : shortest;
}

/// The shortest difference modulo a turn.
double heading_step_rad(std::int16_t newer, std::int16_t older, double units_per_turn) {
  return wrap((newer - older) * (2.0 * kPi / units_per_turn));
}

}  // namespace

Odometer::Odometer(const PioneerSettings& settings, Duration epoch_minus_monotonic)
    : limits_{settings.max_speed_m_s, settings.max_turn_rad_s, settings.stale_s},
      ticks_per_turn_(settings.ticks_per_turn),
      usb_latency_(clock_duration(settings.usb_latency_s)),
      epoch_minus_monotonic_(epoch_minus_monotonic) {}

std::optional<Odometer::Memory> Odometer::memory() const {
  if (!last_) return std::nullopt;
  return Memory{last_->sip.x_units,
                last_->sip.y_units,
                last_->sip.heading_units,
                last_->at,
                T_odom_body_ * since_.T_last_body,
                origin_};
}

void Odometer::restore(const Memory& memory, const OdometerSetup& setup) {
  StandardSip sip;
  sip.x_units = memory.x_units;
  sip.y_units = memory.y_units;
  sip.heading_units = memory.heading_units;
  last_ = Sighting{sip, memory.at};
  T_odom_body_ = memory.T_odom_body;
  origin_ = memory.origin;
  restored_ = true;
  refine(setup);
}

void Odometer::begin_session(const OdometerSetup& setup) {
  if (last_) before_session_ = last_->at;
  last_.reset();
  ++origin_;
  T_odom_body_ = {};
  restored_ = false;
  since_ = {};
  jump_units_.setZero();
  cycle_ = {};
  refine(setup);
}

void Odometer::refine(const OdometerSetup& setup) {
  setup_ = setup;
  ticks_ = WheelTicks(setup.ticks_per_mm, ticks_per_turn_);
  gyro_.reset();
  if (setup.use_gyro) gyro_.emplace(setup.parameters.gyro_scale);
  unpaired_.reset();
  waits_for_ticks_ = false;
  forward_since_pair_m_ = 0.0;
}

std::optional<OdometryReading> Odometer::add(const Message& message, Clock::duration byte_time) {
  const Clock::time_point at = cycle_.start_of(message.packet, byte_time);
  if (const StandardSip* sip = message.sip()) return add_sip(*sip, at);
  if (const auto* encoder = std::get_if<EncoderPacket>(&message.motion)) return add_encoder(*encoder, at);
  if (const auto* gyro = std::get_if<GyroPacket>(&message.motion); gyro && gyro_) gyro_->add(*gyro);
  return std::nullopt;
}

std::optional<OdometryReading> Odometer::add_sip(const StandardSip& sip, Clock::time_point at) {
  if (std::exchange(restored_, false) && !can_follow(*last_, {sip, at})) begin_session(setup_);
  const auto before = std::exchange(last_, Sighting{sip, at});
  if (!before) {
    bridge_outage(at);
    return reading();
  }
  step(*before, *last_);
  if (ticks_.trusted() && ++sips_without_ticks_ > kTicksStopped) ticks_.distrust();
  const bool waits = ticks_.trusted();
  if (unpaired_ && is_same_cycle(unpaired_->at, at)) {
    if (auto paired = pair(unpaired_->packet, waits)) return paired;
  }
  waits_for_ticks_ = waits;
  if (waits) return std::nullopt;
  return emit(std::nullopt);
}

std::optional<OdometryReading> Odometer::add_encoder(const EncoderPacket& packet, Clock::time_point at) {
  if (last_ && is_same_cycle(last_->at, at)) return pair(packet, waits_for_ticks_);
  unpaired_ = Ticks{packet, at};
  return std::nullopt;
}

bool Odometer::is_same_cycle(Clock::time_point a, Clock::time_point b) const {
  return 2.0 * std::abs(in_seconds(a - b)) < setup_.sip_cycle_s;
}

/// To be called when the SIP and the ticks of the same cycle have arrived.
std::optional<OdometryReading> Odometer::pair(const EncoderPacket& packet, bool wanted) {
  unpaired_.reset();
  waits_for_ticks_ = false;
  sips_without_ticks_ = 0;
  const auto motion = ticks_.advance(packet, std::exchange(forward_since_pair_m_, 0.0));
  if (!wanted) return std::nullopt;
  return emit(ticks_tell_the_way() ? motion : std::nullopt);
}

/// True: the ticks can be used. Over several cycles (SIPs lost or waiting) ticks do not show where on the way the robot
/// turned, but the controller's counters do. A path whose final heading equals its initial one is straight only if it
/// is short.
bool Odometer::ticks_tell_the_way() const {
  if (since_.sips != 1 || since_.elapsed_s > limits_.stale_s) return false;
  const bool one_cycle = since_.elapsed_s < kOneCycle * setup_.sip_cycle_s;
  return one_cycle ||
         std::abs(since_.turn_rad) <= kStraight_units * 2.0 * kPi / setup_.parameters.heading_units_per_turn;
}

void Odometer::step(const Sighting& before, const Sighting& now) {
  const RobotParameters& robot = setup_.parameters;
  const double elapsed_s = std::max(0.0, in_seconds(now.at - before.at));
  const Eigen::Vector2d step_units(counter_step(now.sip.x_units, before.sip.x_units, jump_units_.x()),
                                   counter_step(now.sip.y_units, before.sip.y_units, jump_units_.y()));
  const Eigen::Vector2d p_odom = robot.distance_m_per_unit * step_units;
  const double heading_rad = before.sip.heading_units * (2.0 * kPi / robot.heading_units_per_turn);
  const double turn_rad =
      heading_step_rad(now.sip.heading_units, before.sip.heading_units, robot.heading_units_per_turn);
  const Eigen::Vector2d p_body = rotated(p_odom, -heading_rad);
  since_.T_last_body = since_.T_last_body * Pose2{p_body.x(), p_body.y(), turn_rad};
  since_.turn_rad += turn_rad;
  since_.elapsed_s += elapsed_s;
  ++since_.sips;
  since_.standing = since_.standing && p_odom.isZero(0.0) && turn_rad == 0.0 && now.sip.left_velocity_units == 0 &&
                    now.sip.right_velocity_units == 0;
  const double forward_m = rotated(p_body, -0.5 * turn_rad).x();
  since_.forward_m += forward_m;
  forward_since_pair_m_ += forward_m;
  const bool possible = judge(p_odom.norm(), std::abs(turn_rad), elapsed_s);
  jump_units_ = possible ? Eigen::Vector2d(0.0, 0.0) : step_units;
}

bool Odometer::is_possible(double length_m, double elapsed_s) const {
  const double possible_s = kFasterThanPossible * std::max(elapsed_s, setup_.sip_cycle_s);
  return length_m <= limits_.speed_m_s * possible_s + kRounding_units * setup_.parameters.distance_m_per_unit;
}

/// True: `now` can follow `before` in the same session of the same robot.
bool Odometer::can_follow(const Sighting& before, const Sighting& now) const {
  const Eigen::Vector2d step_units(counter_step(now.sip.x_units, before.sip.x_units, 0.0),
                                   counter_step(now.sip.y_units, before.sip.y_units, 0.0));
  return is_possible(setup_.parameters.distance_m_per_unit * step_units.norm(), in_seconds(now.at - before.at));
}

/// Adds the uncertainty of a step. False: the robot cannot have moved that far.
bool Odometer::judge(double length_m, double turn_rad, double elapsed_s) {
  const RobotParameters& robot = setup_.parameters;
  const double possible_s = kFasterThanPossible * std::max(elapsed_s, setup_.sip_cycle_s);
  const double reach_m = limits_.speed_m_s * elapsed_s;
  const bool possible = is_possible(length_m, elapsed_s);
  if (!possible) add_sigma(length_m, 0.0);
  if (turn_rad > limits_.turn_rad_s * possible_s + kRounding_units * 2.0 * kPi / robot.heading_units_per_turn)
    add_sigma(0.0, turn_rad);
  // The counter may have wrapped unnoticed.
  if (reach_m > 0.5 * kCounterRange_units * robot.distance_m_per_unit) add_sigma(reach_m, 0.0);
  if (elapsed_s > limits_.stale_s) {
    const double turning_rad_s = std::max(kIndoorTurn_rad_s, std::abs(turn_rad_s_));
    add_sigma(kHiddenPath * reach_m, std::min(kPi, kHiddenPath * turning_rad_s * elapsed_s));
  }
  return possible;
}

void Odometer::add_sigma(double sigma_m, double sigma_rad) {
  since_.sigma_m = std::hypot(since_.sigma_m, sigma_m);
  since_.sigma_rad = std::hypot(since_.sigma_rad, sigma_rad);
}

void Odometer::bridge_outage(Clock::time_point at) {
  if (!before_session_) return;
  const double drive_s = std::min(kLongestDrive_s, in_seconds(at - *before_session_));
  const double turning_rad_s = std::max(kMayTurn_rad_s, std::abs(turn_rad_s_));
  add_sigma(kPushed_m + std::abs(speed_m_s_) * drive_s, std::min(kPi, kPushed_rad + turning_rad_s * drive_s));
  before_session_.reset();
}

// The next reading, from the motion since the last one.

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
