// Any bytes as a stream from a Pioneer. Every byte must belong to a packet or be counted, a valid packet after them
// must be found, and the content of every packet must survive decoding and encoding.

#include <algorithm>
#include <array>

#include "drivers/pioneer/motion_packets.hpp"
#include "tests/drivers/pioneer/conversation.hpp"

namespace azimuth::pioneer {
namespace {

using test::require;

void check_packet(const Packet& packet) {
  require(!packet.data.empty() && packet.data.size() <= kMaxDataSize);
  decode_command(packet.data);
  if (const auto sip = decode_sip(packet.data)) require(decode_sip(test::data_of(encode_sip(*sip))) == sip);
  if (const auto config = decode_config(packet.data))
    require(decode_config(test::data_of(encode_config(*config))) == config);
  if (const auto encoder = decode_encoder(packet.data))
    require(decode_encoder(test::data_of(encode_encoder(*encoder))) == encoder);
  if (const auto gyro = decode_gyro(packet.data)) require(decode_gyro(test::data_of(encode_gyro(*gyro))) == gyro);
}

/// Feeds the stream in pieces and returns the total size of all packets found.
std::size_t scan(PacketScanner& scanner, ByteView stream, std::size_t piece) {
  std::size_t in_packets = 0;
  while (!stream.empty()) {
    stream = stream.subspan(scanner.add(stream.first(std::min(piece, stream.size())), {}));
    while (const auto packet = scanner.next()) {
      check_packet(*packet);
      in_packets += packet->data.size() + kFrameOverhead;
    }
  }
  return in_packets;
}

void check_stream(ByteView stream, std::size_t piece) {
  PacketScanner scanner(is_plausible_config);
  std::size_t in_packets = scan(scanner, stream, piece);
  // After this many zero bytes any packet announced by the stream has ended, so that the next valid packet must be
  // found.
  constexpr std::array<std::uint8_t, kMaxFrameSize> kSilence{};
  in_packets += scan(scanner, kSilence, piece);
  const Frame good = encode_frame(std::array<std::uint8_t, 3>{0x32, 1, 2});
  const std::size_t found = scan(scanner, good.view(), piece);
  require(found == good.size);
  require(in_packets + found + scanner.skipped_bytes() == stream.size() + kSilence.size() + good.size);
}

}  // namespace
}  // namespace azimuth::pioneer

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  azimuth::pioneer::check_stream({data + 1, size - 1}, 1U + data[0]);
  return 0;
}
