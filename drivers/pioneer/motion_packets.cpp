#include "drivers/pioneer/motion_packets.hpp"

#include <algorithm>

#include "drivers/pioneer/fields.hpp"

namespace azimuth::pioneer {
namespace {

/// Visits the fields before the sonar block in their order on the wire, for reading as well as for writing. False: the
/// fields ended early.
template <class Sip, class Field>
bool each_before_sonars(Sip& sip, Field field) {
  return field(sip.x_units) && field(sip.y_units) && field(sip.heading_units) && field(sip.left_velocity_units) &&
         field(sip.right_velocity_units) && field(sip.battery_decivolts) && field(sip.left_stall_and_rear_bumpers) &&
         field(sip.right_stall_and_front_bumpers) && field(sip.control_units) && field(sip.flags) &&
         field(sip.compass_2deg) && field(sip.sonar_count);
}

template <class Sip, class Field>
bool each_after_sonars(Sip& sip, Field field) {
  auto& ports = sip.ports;
  return field(ports.grip_state) && field(ports.analog_port) && field(ports.analog) && field(ports.digital_in) &&
         field(ports.digital_out) && field(sip.battery_x10_decivolts) && field(sip.charge_state) &&
         field(sip.rotation_ddeg_per_s) && field(sip.fault_flags) && field(sip.lateral_velocity_mm_per_s) &&
         field(sip.temperature_C) && field(sip.charge_percent) && field(sip.time_us) && field(sip.flags3);
}

/// Reads the complete sonars, and sets sonar_count to their number.
bool read_sonars(FieldReader& reader, StandardSip& sip) {
  const std::size_t announced = sip.sonar_count;
  for (sip.sonar_count = 0; sip.sonar_count < announced; ++sip.sonar_count) {
    StandardSip::SonarReading sonar;
    if (!reader.read(sonar.index) || !reader.read(sonar.range_units)) return false;
    sip.sonars[sip.sonar_count] = sonar;
  }
  return true;
}

}  // namespace

std::optional<StandardSip> decode_sip(ByteView data) {
  if (data.empty() || !packet_id::is_sip(data.front())) return std::nullopt;
  StandardSip sip;
  FieldReader reader(data);
  const auto read = [&reader](auto& field) { return reader.read(field); };
  reader.read(sip.id);
  if (!each_before_sonars(sip, read)) return std::nullopt;
  if (read_sonars(reader, sip)) each_after_sonars(sip, read);
  return sip;
}

Frame encode_sip(const StandardSip& sip) {
  FieldWriter writer(sip.id);
  const auto write = [&writer](const auto& field) { return writer.write(field); };
  each_before_sonars(sip, write);
  const std::size_t sonars = std::min<std::size_t>(sip.sonar_count, StandardSip::kMaxSonars);
  for (std::size_t i = 0; i < sonars; ++i) {
    writer.write(sip.sonars[i].index);
    writer.write(sip.sonars[i].range_units);
  }
  each_after_sonars(sip, write);
  return writer.frame();
}

std::optional<EncoderPacket> decode_encoder(ByteView data) {
  if (data.empty() || data.front() != packet_id::encoder) return std::nullopt;
  EncoderPacket encoder;
  FieldReader reader(data.subspan(1));
  if (!reader.read(encoder.left_ticks) || !reader.read(encoder.right_ticks)) return std::nullopt;
  return encoder;
}

std::optional<GyroPacket> decode_gyro(ByteView data) {
  if (data.empty() || data.front() != packet_id::gyro) return std::nullopt;
  GyroPacket gyro;
  FieldReader reader(data.subspan(1));
  std::uint8_t announced = 0;
  if (!reader.read(announced)) return std::nullopt;
  for (; gyro.count < announced; ++gyro.count) {
    GyroPacket::Sample sample;
    if (!reader.read(sample.rate) || !reader.read(sample.temperature)) break;
    gyro.samples[gyro.count] = sample;
  }
  return gyro;
}

Frame encode_encoder(const EncoderPacket& encoder) {
  FieldWriter writer(packet_id::encoder);
  writer.write(encoder.left_ticks);
  writer.write(encoder.right_ticks);
  return writer.frame();
}

Frame encode_gyro(const GyroPacket& gyro) {
  FieldWriter writer(packet_id::gyro);
  const auto count = static_cast<std::uint8_t>(std::min<std::size_t>(gyro.count, GyroPacket::kMaxSamples));
  writer.write(count);
  for (std::size_t i = 0; i < count; ++i) {
    writer.write(gyro.samples[i].rate);
    writer.write(gyro.samples[i].temperature);
  }
  return writer.frame();
}

Message decoded(const Packet& packet) {
  Message message{.packet = packet, .motion = {}};
  if (const auto sip = decode_sip(packet.data)) {
    message.motion = *sip;
  } else if (const auto encoder = decode_encoder(packet.data)) {
    message.motion = *encoder;
  } else if (const auto gyro = decode_gyro(packet.data)) {
    message.motion = *gyro;
  }
  return message;
}

}  // namespace azimuth::pioneer
