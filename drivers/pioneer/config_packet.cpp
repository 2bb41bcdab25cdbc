#include "drivers/pioneer/config_packet.hpp"

#include <algorithm>
#include <initializer_list>

#include "drivers/pioneer/fields.hpp"
#include "drivers/pioneer/protocol.hpp"

namespace azimuth::pioneer {
namespace {

/// Visits the fields in their order on the wire, for reading as well as for writing. False: the fields ended early.
template <class Config, class Field>
bool each_required(Config& c, Field field) {
  return field(c.robot_class) && field(c.subclass) && field(c.serial_number) && field(c.equipment.four_motors) &&
         field(c.top.rotation_deg_per_s) && field(c.top.velocity_mm_per_s) &&
         field(c.top.rotation_acceleration_deg_per_s2) && field(c.top.acceleration_mm_per_s2) && field(c.pwm_max) &&
         field(c.name) && field(c.sip_cycle_ms);
}

template <class Control, class Field>
bool each_of_control(Control& c, Field field) {
  return field(c.acceleration) && field(c.deceleration) && field(c.kp) && field(c.kv) && field(c.ki);
}

template <class Config, class Field>
bool each_other(Config& c, Field field) {
  return field(c.baud_codes.host) && field(c.baud_codes.aux1) && field(c.equipment.gripper) &&
         field(c.equipment.front_sonar) && field(c.equipment.rear_sonar) && field(c.battery.low_decivolts) &&
         field(c.rev_count) && field(c.watchdog_ms) && field(c.p2mpacs) && field(c.stall.value) &&
         field(c.stall.count) && field(c.joystick.velocity) && field(c.joystick.rotation) &&
         field(c.limits.rotation_deg_per_s) && field(c.limits.velocity_mm_per_s) &&
         each_of_control(c.rotation, field) && each_of_control(c.translation, field) &&
         field(c.equipment.front_bumpers) && field(c.equipment.rear_bumpers) && field(c.equipment.charger) &&
         field(c.sonar_cycle) && field(c.auto_baud) && field(c.gyro) && field(c.gyro_factors.drift) &&
         field(c.baud_codes.aux2) && field(c.baud_codes.aux3) && field(c.ticks_per_mm) &&
         field(c.battery.shutdown_decivolts) && field(c.firmware_version) && field(c.gyro_factors.clockwise) &&
         field(c.gyro_factors.counter_clockwise) && field(c.kinematics_delay_ms);
}

bool is_printable(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

bool is_within(int value, int least, int most) { return value >= least && value <= most; }

}  // namespace

std::optional<ConfigPacket> decode_config(ByteView data) {
  if (data.empty() || data.front() != packet_id::config) return std::nullopt;
  ConfigPacket config;
  FieldReader reader(data.subspan(1));
  const auto read = [&reader](auto& field) { return reader.read(field); };
  if (!each_required(config, read)) return std::nullopt;
  each_other(config, read);
  return config;
}

Frame encode_config(const ConfigPacket& config) {
  FieldWriter writer(packet_id::config);
  const auto write = [&writer](const auto& field) { return writer.write(field); };
  if (each_required(config, write)) each_other(config, write);
  return writer.frame();
}

bool is_plausible_config(ByteView data) {
  const auto config = decode_config(data);
  if (!config || config->robot_class.empty() || config->subclass.empty()) return false;
  for (const std::string* text :
       {&config->robot_class, &config->subclass, &config->serial_number, &config->name, &config->firmware_version}) {
    if (!is_printable(*text)) return false;
  }
  return is_within(config->top.rotation_deg_per_s, 1, 1000) && is_within(config->top.velocity_mm_per_s, 50, 5000) &&
         is_within(config->top.rotation_acceleration_deg_per_s2, 1, 5000) &&
         is_within(config->top.acceleration_mm_per_s2, 1, 20000) && is_within(config->pwm_max, 1, 1023) &&
         is_within(config->sip_cycle_ms, 5, 255) && is_within(config->watchdog_ms, 0, 60000) && config->gyro <= 10;
}

}  // namespace azimuth::pioneer
