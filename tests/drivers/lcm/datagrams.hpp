#pragma once
// Valid and invalid LCM datagrams.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drivers/lcm/lcm_packet.hpp"
#include "drivers/lcm/lcm_sink.hpp"

namespace azimuth::test {

using Datagram = std::vector<std::byte>;

inline void append(Datagram& out, std::uint32_t number, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(number >> shift));
}

inline void append(Datagram& out, std::string_view text) {
  for (const char letter : text) out.push_back(static_cast<std::byte>(letter));
  out.push_back({});
}

inline Datagram whole_message(std::uint32_t sequence, std::string_view channel, Bytes message) {
  Datagram out;
  append(out, 0x4c433032, 4);
  append(out, sequence, 4);
  append(out, channel);
  out.insert(out.end(), message.begin(), message.end());
  return out;
}

struct PartHeader {
  std::uint32_t sequence = 0, size = 0, offset = 0;
  std::uint16_t part = 0, parts = 1;
};

inline Datagram one_part(const PartHeader& header, std::string_view channel, Bytes payload) {
  Datagram out;
  append(out, 0x4c433033, 4);
  append(out, header.sequence, 4);
  append(out, header.size, 4);
  append(out, header.offset, 4);
  append(out, header.part, 2);
  append(out, header.parts, 2);
  if (header.part == 0) append(out, channel);
  out.insert(out.end(), payload.begin(), payload.end());
  return out;
}

inline std::vector<Datagram> in_parts(std::uint32_t sequence, std::string_view channel, Bytes message,
                                      std::size_t part_bytes) {
  std::vector<Datagram> datagrams;
  const auto parts = static_cast<std::uint16_t>((message.size() + part_bytes - 1) / part_bytes);
  for (std::uint16_t part = 0; part < parts; ++part) {
    const std::size_t offset = part * part_bytes;
    datagrams.push_back(one_part(
        {sequence, static_cast<std::uint32_t>(message.size()), static_cast<std::uint32_t>(offset), part, parts},
        channel, message.subspan(offset, std::min(part_bytes, message.size() - offset))));
  }
  return datagrams;
}

/// Processes a datagram like the receiver. Returns false if it is not an LCM datagram.
inline bool offer(LcmSink& sink, Bytes datagram, LcmPeer sender, const LcmReceipt& receipt) {
  const auto packet = decode_lcm_packet(datagram);
  if (packet) sink.accept(*packet, sender, receipt);
  return packet.has_value();
}

}  // namespace azimuth::test
