// The periodic work of the controller.

#include <cmath>
#include <utility>

#include "sim/pioneer/firmware.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth::sim {

void Firmware::roll(const WheelMotion& motion) {
  const auto [left_mm, right_mm] = wheels_.roll(motion);
  motors_.count((left_mm + right_mm) / 2 / 1000.0, (right_mm - left_mm) / model_.track_mm);
  gyro_.turn(motion.body_turn_rad);
}

void Firmware::advance(Stamp now) {
  now_ = now;
  if (session_ != Session::open || now < next_sample_) return;
  if (now - last_command_ >= std::chrono::milliseconds(quirks.watchdog_ms.value_or(model_.watchdog_ms)))
    motors_.hold(true);
  motors_.advance(to_seconds(sample_period()));
  gyro_.sample(to_seconds(sample_period()));
  next_sample_ += sample_period();
  if (++samples_ == kSamplesPerCycle) end_cycle();
}

void Firmware::end_cycle() {
  samples_ = 0;
  send_gyro();
  send_sip();
  send_encoder();
  send_io();
}

bool Firmware::gyro_streams() const {
  if (quirks.gyro == Stream::always) return true;
  return quirks.gyro == Stream::on_request && model_.has_gyro && gyro_request_;
}

void Firmware::send_gyro() {
  const std::vector<GyroSample> samples = gyro_.take();
  if (gyro_streams()) send(gyro_packet(samples));
}

void Firmware::send_sip() {
  const WheelCounter::Travel travel = wheels_.take_travel();
  const RawPose pose = wheels_.raw(quirks.position_bits.value_or(model_.position_bits));
  const std::vector<SonarReading> sonar = sonar_.ping(quirks.resends_sonar);
  const double cycle_s = model_.sip_cycle_ms / 1000.0;
  const auto velocity = [&](double travel_mm) {
    return static_cast<std::int16_t>(std::lround(travel_mm / cycle_s / model_.velocity_mm_per_s));
  };
  const double turn_rad_per_s = (travel.right_mm - travel.left_mm) / model_.track_mm / cycle_s;
  SipFields fields;
  fields.left_velocity = velocity(travel.left_mm);
  fields.right_velocity = velocity(travel.right_mm);
  const bool moving = fields.left_velocity != 0 || fields.right_velocity != 0;
  fields.id = sip_id(moving);
  fields.x = pose.x;
  fields.y = pose.y;
  fields.heading = pose.heading;
  fields.control = heading_count(wrap(wheels_.heading_rad() + motors_.turn_left_rad()));
  fields.battery_v = model_.battery_v;
  fields.left_stall_bumpers = quirks.left_stall_bumpers;
  fields.right_stall_bumpers = quirks.right_stall_bumpers;
  fields.flags = flags(moving);
  fields.sonar = sonar;
  fields.analog_port = analog_port_;
  fields.digital_out = digital_out_;
  fields.rotation_velocity_ddeg_per_s = static_cast<std::int16_t>(std::lround(10.0 * rad_to_degrees(turn_rad_per_s)));
  send(sip_packet(fields), SipLatch{now_, pose});
}

std::uint8_t Firmware::sip_id(bool moving) const {
  const bool says_moving = quirks.sip_id == SipId::as_moving ? moving : quirks.sip_id == SipId::always_moving;
  return says_moving ? pioneer::packet_id::sip_moving : pioneer::packet_id::sip_stopped;
}

std::uint16_t Firmware::flags(bool moving) const {
  unsigned flags = 0;
  if (motors_.enabled() || moving) flags |= 1U;  // A robot that is driven has its motors enabled
  if (sonar_.on()) flags |= 1U << 1U;
  if (motors_.emergency_stopped() || quirks.emergency_stop) flags |= 1U << 5U;
  return static_cast<std::uint16_t>(flags);
}

void Firmware::send_encoder() {
  const bool asked = encoder_request_.take() && quirks.encoder == Stream::on_request;
  if (asked || quirks.encoder == Stream::always) send(encoder_packet(wheels_.left_ticks(), wheels_.right_ticks()));
}

void Firmware::send_io() {
  if (!io_request_.take()) return;
  IoFields fields;
  fields.front_bumpers = quirks.right_stall_bumpers >> 1U;
  fields.rear_bumpers = quirks.left_stall_bumpers >> 1U;
  fields.digital_out = digital_out_;
  send(io_packet(fields));
}

void Firmware::send_config() {
  pioneer::Frame frame = config_packet(model_, motors_.limits(), pioneer::baud_code(model_.start_baud).value_or(0));
  if (quirks.bad_config_checksum) frame.bytes[frame.size - 1] ^= 0x5A;
  send(frame);
}

void Firmware::send(const pioneer::Frame& frame, std::optional<SipLatch> latch) {
  output_.push_back({frame, baud_, latch});
}

std::vector<Outgoing> Firmware::take_output() { return std::exchange(output_, {}); }

}  // namespace azimuth::sim
