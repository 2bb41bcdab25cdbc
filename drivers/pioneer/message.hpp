#pragma once
#include <variant>

#include "drivers/pioneer/motion_packets.hpp"
#include "drivers/pioneer/packet.hpp"
#include "drivers/pioneer/standard_sip.hpp"

namespace azimuth::pioneer {

/// A packet with its decoded motion data. It is decoded once for session, odometer and driver. Borrows as a Packet
/// does.
struct Message {
  Packet packet;
  /// Empty for a packet of another kind, or a truncated one.
  std::variant<std::monostate, StandardSip, EncoderPacket, GyroPacket> motion;

  std::uint8_t id() const { return packet.id(); }
  const StandardSip* sip() const { return std::get_if<StandardSip>(&motion); }
};

/// Thread contract: reentrant; never allocates.
Message decoded(const Packet& packet);

}  // namespace azimuth::pioneer
