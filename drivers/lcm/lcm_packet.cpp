#include "drivers/lcm/lcm_packet.hpp"

#include <algorithm>

#include "drivers/wire/event_codec.hpp"

namespace azimuth {
namespace {

constexpr std::uint32_t kWhole = 0x4c433032, kPart = 0x4c433033;  // "LC02", "LC03"
constexpr std::size_t kWholeHeader = 8, kPartHeader = 20;

/// The big-endian number of `size` bytes, which must be present.
std::uint32_t number_at(Bytes data, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (const std::byte byte : data.subspan(at, size)) number = (number << 8U) | std::to_integer<std::uint32_t>(byte);
  return number;
}

/// Takes a zero-terminated text from the beginning of `data`, with its zero.
std::optional<std::string_view> take_channel(Bytes& data) {
  const Bytes room = data.first(std::min(data.size(), kMaxChannelLength + 1));
  const auto end = std::ranges::find(room, std::byte{0});
  if (end == room.end() || end == room.begin()) return std::nullopt;
  const auto length = static_cast<std::size_t>(end - room.begin());
  const std::string_view channel(reinterpret_cast<const char*>(data.data()), length);
  data = data.subspan(length + 1);
  return channel;
}

std::optional<LcmPacket> decode_whole(Bytes datagram) {
  LcmPacket packet{.sequence = number_at(datagram, 4, 4), .channel = {}, .payload = datagram.subspan(kWholeHeader)};
  const std::optional<std::string_view> channel = take_channel(packet.payload);
  if (!channel) return std::nullopt;
  packet.channel = *channel;
  packet.size = static_cast<std::uint32_t>(packet.payload.size());
  return packet;
}

std::optional<LcmPacket> decode_part(Bytes datagram) {
  if (datagram.size() < kPartHeader) return std::nullopt;
  LcmPacket packet{.sequence = number_at(datagram, 4, 4),
                   .channel = {},
                   .payload = datagram.subspan(kPartHeader),
                   .size = number_at(datagram, 8, 4),
                   .offset = number_at(datagram, 12, 4),
                   .part = static_cast<std::uint16_t>(number_at(datagram, 16, 2)),
                   .parts = static_cast<std::uint16_t>(number_at(datagram, 18, 2))};
  if (packet.part >= packet.parts) return std::nullopt;
  if (packet.part == 0) {
    const std::optional<std::string_view> channel = take_channel(packet.payload);
    if (!channel) return std::nullopt;
    packet.channel = *channel;
  }
  const bool fits = packet.offset <= packet.size && packet.payload.size() <= packet.size - packet.offset;
  return fits ? std::optional(packet) : std::nullopt;
}

}  // namespace

std::optional<LcmPacket> decode_lcm_packet(Bytes datagram) {
  if (datagram.size() < kWholeHeader || datagram.size() > kMaxDatagram) return std::nullopt;
  const std::uint32_t kind = number_at(datagram, 0, 4);
  if (kind == kWhole) return decode_whole(datagram);
  return kind == kPart ? decode_part(datagram) : std::nullopt;
}

}  // namespace azimuth
