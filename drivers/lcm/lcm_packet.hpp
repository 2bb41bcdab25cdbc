#pragma once
// LCM's datagrams. liblcm is not used for receiving, because a crafted fragment makes it write outside its buffers, and
// because it reserves any size that a sender claims.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/bytes.hpp"

namespace azimuth {

/// One datagram: a whole message, or a part of one. Borrows the datagram's bytes.
struct LcmPacket {
  std::uint32_t sequence = 0;  ///< counts messages of the sender on all channels together
  std::string_view channel;    ///< set for a whole message or a first part; otherwise empty
  Bytes payload;               ///< bytes of the message from `offset` on
  std::uint32_t size = 0;      ///< size of the message
  std::uint32_t offset = 0;    ///< offset + payload.size() <= size
  std::uint16_t part = 0;      ///< number of this part, below `parts`
  std::uint16_t parts = 1;     ///< 1: the message is whole
};

inline constexpr std::size_t kMaxDatagram = 65536;

/// None when the bytes are not a datagram of LCM, or are inconsistent. Thread contract: reentrant.
std::optional<LcmPacket> decode_lcm_packet(Bytes datagram);

}  // namespace azimuth
