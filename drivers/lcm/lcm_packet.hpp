#pragma once
// LCM's datagrams. liblcm is not used to receive: a crafted fragment makes it write outside its buffers, and it keeps
// whatever sizes the sender claims.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/bytes.hpp"

namespace azimuth {

/// One datagram: a whole message, or a part of one. Borrows the datagram's bytes.
struct LcmPacket {
  std::uint32_t sequence = 0;  ///< counts messages of the sender, on all channels together
  std::string_view channel;    ///< of a whole message, or of a first part; else empty
  Bytes payload;               ///< bytes of the message from `offset` on
  std::uint32_t size = 0;      ///< of the message
  std::uint32_t offset = 0;    ///< offset + payload.size() <= size
  std::uint16_t part = 0;      ///< number of this one, below `parts`
  std::uint16_t parts = 1;     ///< 1: the message is whole
};

inline constexpr std::size_t kMaxDatagram = 65536;

/// Nothing when the bytes are no datagram of LCM, or contradict themselves. Thread contract: reentrant.
std::optional<LcmPacket> decode_lcm_packet(Bytes datagram);

}  // namespace azimuth
