#include "sim/pioneer/firmware.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth::sim {
namespace {

// 10 bits for 5 V, 2.5 V for 300 deg/s, and the GyroScaler of the manufacturer's parameter files.
constexpr double kDegPerSPerCount = 5.0 / 1023 * (300 / 2.5) * 1.626;
constexpr double kCentre = 511.3;  // The rest count differs between gyros, so clients must estimate it
constexpr double kSigmaCounts = 0.6;
constexpr std::uint8_t kTemperature = 25;

}  // namespace

using pioneer::Command;
using pioneer::kSync0, pioneer::kSync1, pioneer::kSync2;

namespace {

/// Time after a reboot during which the controller receives nothing.
constexpr Duration kBootTime = std::chrono::milliseconds(500);

}  // namespace

Firmware::Firmware(const PioneerModel& model, std::uint64_t seed, Stamp now)
    : model_(model),
      gyro_(seed),
      sonar_(model),
      motors_(model),
      wheels_(model),
      baud_(model.start_baud),
      now_(now),
      deaf_until_(now),
      next_sample_(now),
      last_command_(now) {}

void Firmware::receive(pioneer::ByteView bytes, Stamp now) {
  now_ = now;
  if (now < deaf_until_) return;
  while (!bytes.empty()) {
    bytes = bytes.subspan(scanner_.add(bytes, pioneer::Clock::time_point(now.time_since_epoch())));
    while (const auto packet = scanner_.next()) obey(pioneer::decode_command(packet->data));
  }
}

void Firmware::obey(const pioneer::DecodedCommand& command) {
  ++commands_;
  last_command_ = now_;
  motors_.hold(false);
  if (session_ == Session::open) {
    serve(command);
  } else {
    synchronise(command.number);
  }
}

void Firmware::synchronise(std::uint8_t number) {
  if (number == kSync0) {
    session_ = Session::expects_sync1;
    send(bare_packet(kSync0));
  } else if (number == kSync1 && session_ == Session::expects_sync1) {
    session_ = Session::expects_sync2;
    send(bare_packet(kSync1));
  } else if (number == kSync2 && session_ == Session::expects_sync2) {
    session_ = Session::expects_open;
    send(names_packet(model_));
  } else if (number == kSync1 && session_ == Session::expects_open) {  // OPEN in this state
    open(now_);
  } else if (number == kSync2 && (session_ == Session::expects_open || session_ == Session::expects_sync0)) {
    session_ = Session::expects_sync0;                // CLOSE in these states
  } else if (number == kSync1 || number == kSync2) {  // Wrong sync number
    session_ = Session::expects_sync0;
    send(bare_packet(pioneer::packet_id::reboot));
  }
}

void Firmware::open(Stamp now) {
  now_ = last_command_ = now;
  session_ = Session::open;
  wheels_.reset_pose(quirks.start_units, quirks.start_units, quirks.start_heading_rad);
  wheels_.take_travel();
  sonar_.switch_on(true);  // Like real controllers; clients that do not want sonar switch it off
  encoder_request_.ask(0);
  io_request_.ask(0);
  gyro_request_ = false;
  analog_port_ = digital_out_ = 0;
  gyro_.restart();
  samples_ = 0;
  next_sample_ = now + sample_period();
}

void Firmware::close() {
  session_ = Session::expects_sync0;
  motors_.release();
  if (model_.baud_resets) baud_ = model_.start_baud;
}

void Firmware::reboot(std::uint8_t id, Stamp now) {
  now_ = now;
  send(bare_packet(id));
  close();
  baud_ = model_.start_baud;
  wheels_ = WheelCounter(model_);
  scanner_.clear();
  deaf_until_ = now + kBootTime;
}

void Firmware::serve(const pioneer::DecodedCommand& command) {
  const int value = command.value.value_or(0);
  switch (static_cast<Command>(command.number)) {
    case Command::close:
      return close();
    case Command::set_origin:
      return wheels_.reset_pose();
    case Command::host_baud:
      return set_host_baud(value);
    case Command::analog_select:
      analog_port_ = static_cast<std::uint8_t>(value);
      return;
    case Command::digital_out:
      return set_outputs(value);
    default:
      stream(static_cast<Command>(command.number), value);
      drive(static_cast<Command>(command.number), value);
  }
}

/// Executes commands about packets.
void Firmware::stream(Command command, int value) {
  switch (command) {
    case Command::config:
      return send_config();
    case Command::encoder:
      return encoder_request_.ask(value);
    case Command::io_request:
      return io_request_.ask(value);
    case Command::gyro:
      gyro_request_ = value != 0;
      return;
    case Command::sonar:
      return sonar_.switch_on((value & 1) != 0);
    default:
      return;
  }
}

/// The high byte selects the outputs, the low byte gives their values.
void Firmware::set_outputs(int value) {
  const auto which = static_cast<unsigned>(value) >> 8U, state = static_cast<unsigned>(value);
  digital_out_ = static_cast<std::uint8_t>((digital_out_ & ~which) | (state & which));
}

void Firmware::set_host_baud(int code) {
  const std::optional<int> baud = pioneer::baud_of_code(code);
  if (baud && !quirks.refuses_host_baud) baud_ = *baud;
}

// Commands that move the robot, and commands that set limits of the motion.

void Firmware::drive(Command command, int value) {
  switch (command) {
    case Command::enable:
      return motors_.enable(value != 0);
    case Command::velocity:
      return motors_.order_speed(value / 1000.0);
    case Command::rotate:
    case Command::rotation:
      return motors_.order_turn_rate(degrees_to_rad(value));
    case Command::move:
      return motors_.order_distance(value / 1000.0);
    case Command::heading:
      return motors_.order_turn(wrap(degrees_to_rad(value) - wheels_.heading_rad()));
    case Command::relative_heading:
      return motors_.order_turn(wrap(degrees_to_rad(value)));
    case Command::heading_from_set_point:
      return motors_.order_turn(wrap(degrees_to_rad(value) + motors_.turn_left_rad()));
    case Command::wheel_velocities:
      return drive_wheels(value);
    case Command::stop:
      return motors_.stop();
    case Command::emergency_stop:
      return motors_.emergency_stop();
    default:
      return limit(command, value);
  }
}

void Firmware::drive_wheels(int value) {
  constexpr double kDivisor_m_per_s = 0.020;  // Vel2Divisor
  const double right = kDivisor_m_per_s * static_cast<std::int8_t>(value & 0xFF);
  const double left = kDivisor_m_per_s * static_cast<std::int8_t>((value >> 8) & 0xFF);
  motors_.order_wheels(left, right);
}

/// The sign of an acceleration tells whether it is for speeding up or for slowing down.
void Firmware::limit(Command command, int value) {
  switch (command) {
    case Command::set_max_velocity:
      return motors_.limit(&MotionLimits::speed_mm_per_s, value);
    case Command::set_max_rotation:
      return motors_.limit(&MotionLimits::turn_rate_deg_per_s, value);
    case Command::set_acceleration:
      return motors_.limit(value < 0 ? &MotionLimits::deceleration_mm_per_s2 : &MotionLimits::acceleration_mm_per_s2,
                           value);
    case Command::set_rotation_acceleration:
      return motors_.limit(
          value < 0 ? &MotionLimits::turn_deceleration_deg_per_s2 : &MotionLimits::turn_acceleration_deg_per_s2, value);
    default:
      return;
  }
}

void Gyro::sample(double period_s) {
  const double rate_deg_per_s = rad_to_degrees(turned_rad_ / period_s);
  turned_rad_ = 0.0;
  // Clockwise rotation counts up.
  const double counts = kCentre - rate_deg_per_s / kDegPerSPerCount + random_.normal(kSigmaCounts);
  samples_.push_back({static_cast<std::uint16_t>(std::clamp(std::lround(counts), 0L, 1023L)), kTemperature});
}

void Gyro::restart() {
  turned_rad_ = 0.0;
  samples_.clear();
}

std::vector<GyroSample> Gyro::take() { return std::exchange(samples_, {}); }

std::vector<SonarReading> Sonar::ping(bool all) {
  constexpr std::uint16_t kNothing_mm = 5000;
  constexpr int kArrays = 2;  // The front and the rear array fire at the same time
  const int fired = std::min(model_.sonars, kArrays * model_.sip_cycle_ms / model_.sonar_cycle_ms);
  const int count = all ? model_.sonars : (on_ ? fired : 0);
  std::vector<SonarReading> readings;
  for (int i = 0; i < count; ++i) {
    readings.push_back({static_cast<std::uint8_t>(next_), kNothing_mm});
    next_ = (next_ + 1) % model_.sonars;
  }
  return readings;
}

}  // namespace azimuth::sim
