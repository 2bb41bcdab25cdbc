#include "drivers/pioneer/motion_packets.hpp"

#include <algorithm>

#include "drivers/pioneer/fields.hpp"
#include "drivers/pioneer/protocol.hpp"

namespace azimuth::pioneer {

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

}  // namespace azimuth::pioneer
