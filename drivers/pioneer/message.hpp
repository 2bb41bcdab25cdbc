#pragma once
#include <variant>

#include "drivers/pioneer/motion_packets.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/standard_sip.hpp"

namespace azimuth::pioneer {

/// A packet, and what it says of the robot's motion: decoded once for session, odometer and driver. Borrows as a Packet
/// does.
struct Message {
  Packet packet;
  /// Nothing: a packet of another kind, or one that is cut short.
  std::variant<std::monostate, StandardSip, EncoderPacket, GyroPacket> motion;

  std::uint8_t id() const { return packet.id(); }
  const StandardSip* sip() const { return std::get_if<StandardSip>(&motion); }
};

/// Thread contract: reentrant; never allocates.
Message decoded(const Packet& packet);

}  // namespace azimuth::pioneer
