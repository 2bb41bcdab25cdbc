#include "sim/pioneer/packets.hpp"

#include <cmath>
#include <string>

#include "drivers/pioneer/protocol.hpp"

namespace azimuth::sim {
namespace {

/// Collects a packet's data in wire order.
class DataWriter {
 public:
  explicit DataWriter(std::uint8_t id) { u8(id); }

  DataWriter& u8(int value) {
    data_.push_back(static_cast<std::uint8_t>(value));
    return *this;
  }
  DataWriter& u16(int value) { return u8(value & 0xFF).u8((value >> 8) & 0xFF); }
  DataWriter& i32(std::int32_t value) { return u16(value & 0xFFFF).u16((value >> 16) & 0xFFFF); }
  DataWriter& text(std::string_view value) {
    data_.insert(data_.end(), value.begin(), value.end());
    return u8(0);
  }
  pioneer::Frame frame() const { return pioneer::encode_frame(data_); }

 private:
  Bytes data_;
};

int decivolts(double volts) { return static_cast<int>(std::lround(10.0 * volts)); }

/// rotVelTop, transVelTop, rotAccTop, transAccTop.
void write_top_limits(DataWriter& data, const MotionLimits& top) {
  data.u16(top.turn_rate_deg_per_s).u16(top.speed_mm_per_s);
  data.u16(top.turn_acceleration_deg_per_s2).u16(top.acceleration_mm_per_s2);
}

void write_motion_limits(DataWriter& data, const MotionLimits& limits) {
  data.u16(limits.turn_rate_deg_per_s).u16(limits.speed_mm_per_s);  // rotVelMax, transVelMax
  data.u16(limits.turn_acceleration_deg_per_s2).u16(limits.turn_deceleration_deg_per_s2);
  data.u16(40).u16(20).u16(0);  // rotKp, rotKv, rotKi
  data.u16(limits.acceleration_mm_per_s2).u16(limits.deceleration_mm_per_s2);
  data.u16(40).u16(30).u16(0);  // transKp, transKv, transKi
}

}  // namespace

pioneer::Frame sip_packet(const SipFields& fields) {
  DataWriter data(fields.id);
  data.u16(fields.x).u16(fields.y).u16(fields.heading).u16(fields.left_velocity).u16(fields.right_velocity);
  data.u8(decivolts(fields.battery_v)).u8(fields.left_stall_bumpers).u8(fields.right_stall_bumpers);
  data.u16(fields.control).u16(fields.flags).u8(0);  // no compass
  data.u8(static_cast<int>(fields.sonar.size()));
  for (const SonarReading& reading : fields.sonar) data.u8(reading.index).u16(reading.range_mm);
  data.u8(0).u8(fields.analog_port).u8(0).u8(0);  // gripper, analog port, analog, digital in
  data.u8(fields.digital_out);
  data.u16(decivolts(fields.battery_v)).u8(0);                  // not charging
  data.u16(fields.rotation_velocity_ddeg_per_s).u16(0).u16(0);  // no faults, no sideways velocity
  data.u8(-127).u8(0);                                          // no thermometer; state of charge unknown
  return data.frame();
}

pioneer::Frame names_packet(const PioneerModel& model) {
  return DataWriter(pioneer::kSync2).text(model.name).text(model.type).text(model.subclass).frame();
}

pioneer::Frame config_packet(const PioneerModel& model, const MotionLimits& limits, int host_baud_code) {
  DataWriter data(pioneer::packet_id::config);
  data.text(model.type).text(model.subclass).text(model.serial_number).u8(0);  // not four motors
  write_top_limits(data, model.top);
  data.u16(500);  // pwmMax
  data.text(model.name).u8(model.sip_cycle_ms).u8(host_baud_code).u8(0);
  data.u16(0).u16(1).u8(model.sonars > 8 ? 1 : 0);  // no gripper; front and rear sonar
  data.u16(110).u16(model.rev_count).u16(model.watchdog_ms).u8(0);
  data.u16(150).u16(10).u16(500).u16(50);  // stall value and count, joystick speeds
  write_motion_limits(data, limits);
  data.u8(0).u8(0).u8(0).u8(model.sonar_cycle_ms);  // bumpers, charger
  data.u8(model.baud_resets ? 2 : 0).u8(model.has_gyro ? 1 : 0).u16(0).u8(0).u8(0);
  data.u16(model.ticks_per_mm).u16(105).text(model.firmware_version);
  data.u16(0).u16(0).u8(0);  // gyro factors, kinematics delay
  return data.frame();
}

pioneer::Frame encoder_packet(std::int32_t left_ticks, std::int32_t right_ticks) {
  return DataWriter(pioneer::packet_id::encoder).i32(left_ticks).i32(right_ticks).frame();
}

pioneer::Frame io_packet(const IoFields& fields) {
  constexpr int kNothingNear = 0xFF;  // Value of the infrared inputs, whose lines go low when an object is near
  constexpr int kAnalogInputs = 8;
  DataWriter data(pioneer::packet_id::io);
  data.u8(4).u8(fields.digital_in).u8(fields.front_bumpers).u8(fields.rear_bumpers).u8(kNothingNear);
  data.u8(1).u8(fields.digital_out);
  data.u8(kAnalogInputs);
  for (int i = 0; i < kAnalogInputs; ++i) data.u16(0);
  return data.frame();
}

pioneer::Frame gyro_packet(std::span<const GyroSample> samples) {
  DataWriter data(pioneer::packet_id::gyro);
  data.u8(static_cast<int>(samples.size()));
  for (const GyroSample& sample : samples) data.u16(sample.rate).u8(sample.temperature);
  return data.frame();
}

pioneer::Frame bare_packet(std::uint8_t id) { return DataWriter(id).frame(); }

}  // namespace azimuth::sim
