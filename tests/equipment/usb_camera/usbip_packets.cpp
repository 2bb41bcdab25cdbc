#include "tests/equipment/usb_camera/usbip_packets.hpp"

#include <algorithm>

namespace azimuth::sim {
namespace {

constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitReply = 3, kUnlinkReply = 4;
// Offsets in the header.
constexpr std::size_t kCommand = 0, kSequence = 4, kDirection = 12, kEndpoint = 16, kFirst = 20, kSecond = 24,
                      kPackets = 32, kSetup = 40;
constexpr std::uint32_t kNoPackets = 0xffffffff;  // Marks a transfer that is not isochronous

std::uint32_t word(std::span<const std::uint8_t, kUsbipHeaderBytes> header, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8U | header[place + i];
  return number;
}

void write_word(UsbipHeader& header, std::size_t place, std::uint32_t number) {
  for (std::size_t i = 0; i < 4; ++i) header.at(place + i) = static_cast<std::uint8_t>(number >> (24 - 8 * i));
}

}  // namespace

std::optional<UsbipCommand> decode_usbip(std::span<const std::uint8_t, kUsbipHeaderBytes> header) {
  UsbipCommand command;
  command.sequence = word(header, kSequence);
  command.to_host = word(header, kDirection) != 0;
  command.endpoint = word(header, kEndpoint);
  if (word(header, kCommand) == kUnlink) {
    command.kind = UsbipCommand::Kind::unlink;
    command.victim = word(header, kFirst);
    return command;
  }
  if (word(header, kCommand) != kSubmit) return std::nullopt;
  command.bytes = word(header, kSecond);
  std::ranges::copy(header.subspan<kSetup>(), command.setup.begin());
  return command;
}

UsbipHeader encode_submit_reply(std::uint32_t sequence, int status, std::uint32_t bytes) {
  UsbipHeader header{};
  write_word(header, kCommand, kSubmitReply);
  write_word(header, kSequence, sequence);
  write_word(header, kFirst, static_cast<std::uint32_t>(status));
  write_word(header, kSecond, bytes);
  write_word(header, kPackets, kNoPackets);
  return header;
}

UsbipHeader encode_unlink_reply(std::uint32_t sequence, int status) {
  UsbipHeader header{};
  write_word(header, kCommand, kUnlinkReply);
  write_word(header, kSequence, sequence);
  write_word(header, kFirst, static_cast<std::uint32_t>(status));
  return header;
}

}  // namespace azimuth::sim
