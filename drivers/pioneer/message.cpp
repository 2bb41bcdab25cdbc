#include "drivers/pioneer/message.hpp"

namespace azimuth::pioneer {

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
