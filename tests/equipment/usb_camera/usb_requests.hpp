#pragma once
// USB requests as hosts send them, for tests.

#include "tests/equipment/usb_camera/emulated_camera.hpp"

namespace azimuth::sim::test {

inline constexpr std::uint16_t kPlenty = 1024;

inline ControlRequest get_descriptor(std::uint8_t kind, std::uint8_t index = 0, std::uint16_t length = kPlenty) {
  return {.type = 0x80,
          .request = 6,
          .value = static_cast<std::uint16_t>(kind << 8U | index),
          .index = 0,
          .length = length};
}
inline ControlRequest set_configuration() { return {.type = 0, .request = 9, .value = 1}; }

/// The requests of a host to a new or freshly reset device.
inline void enumerate(EmulatedCamera& camera) {
  camera.control(get_descriptor(1, 0, 64), {});
  camera.control(get_descriptor(2), {});
  camera.control(set_configuration(), {});
}

/// A request to a control of the video class. Entity 0 and the stream's interface select probe and commit.
inline ControlRequest video_request(std::uint8_t request, std::uint8_t selector, std::uint8_t entity,
                                    std::uint8_t interface, std::uint16_t length) {
  return {.type = static_cast<std::uint8_t>((request & 0x80U) | 0x21U),
          .request = request,
          .value = static_cast<std::uint16_t>(selector << 8U),
          .index = static_cast<std::uint16_t>(entity << 8U | interface),
          .length = length};
}

/// Negotiates a format and a rate, and starts the stream.
inline void start_uvc(EmulatedCamera& camera, std::uint8_t format = 1, std::uint32_t interval = 0) {
  Octets probe{1, 0, format, 1};
  put_le(probe, interval);
  probe.resize(26);
  camera.control(video_request(1, 1, 0, 1, 26), probe);
  camera.control(video_request(1, 2, 0, 1, 26), *camera.control(video_request(0x81, 1, 0, 1, 26), {}));
}

inline ControlRequest register_request(bool read, std::uint32_t address, std::uint16_t length) {
  return {.type = static_cast<std::uint8_t>(read ? 0xc0 : 0x40),
          .request = 0x7f,
          .value = static_cast<std::uint16_t>(address),
          .index = static_cast<std::uint16_t>(address >> 16U),
          .length = length};
}

}  // namespace azimuth::sim::test
