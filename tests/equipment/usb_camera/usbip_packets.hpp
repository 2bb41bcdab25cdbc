#pragma once
// The packets between vhci_hcd, the kernel's virtual USB host controller, and a remote device: the part of the "usbip"
// protocol for a device with control and bulk endpoints. All numbers are big-endian, except those of the setup packet.
//
// Thread contract: reentrant.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "tests/equipment/usb_camera/octets.hpp"

namespace azimuth::sim {

inline constexpr std::size_t kUsbipHeaderBytes = 48;
using UsbipHeader = std::array<std::uint8_t, kUsbipHeaderBytes>;

/// A command from the host.
struct UsbipCommand {
  enum class Kind : std::uint8_t { submit, unlink };
  Kind kind = Kind::submit;
  std::uint32_t sequence = 0;
  bool to_host = false;
  std::uint32_t endpoint = 0;
  std::uint32_t bytes = 0;              ///< Submit: bytes that follow the header, or room for the answer
  std::uint32_t victim = 0;             ///< Unlink: sequence number of the transfer to cancel
  std::array<std::uint8_t, 8> setup{};  ///< Submit, for endpoint 0
};

/// Returns nullopt for any other packet.
std::optional<UsbipCommand> decode_usbip(std::span<const std::uint8_t, kUsbipHeaderBytes> header);

/// The end of a transfer: `status` is 0 or a negated errno. For transfers to the host, `bytes` bytes follow the header.
UsbipHeader encode_submit_reply(std::uint32_t sequence, int status, std::uint32_t bytes);

/// `status` is -ECONNRESET if the transfer was cancelled, 0 if it had ended before.
UsbipHeader encode_unlink_reply(std::uint32_t sequence, int status);

}  // namespace azimuth::sim
