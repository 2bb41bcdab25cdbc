#pragma once
// The packets between vhci_hcd, the kernel's virtual USB host controller, and a device elsewhere: the "usbip" protocol
// as far as one device with control and bulk endpoints needs it. All numbers are big-endian, but for the setup packet.
//
// Thread contract: reentrant.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "sim/usb_camera/octets.hpp"

namespace azimuth::sim {

inline constexpr std::size_t kUsbipHeaderBytes = 48;
using UsbipHeader = std::array<std::uint8_t, kUsbipHeaderBytes>;

/// From the host.
struct UsbipCommand {
  enum class Kind : std::uint8_t { submit, unlink };
  Kind kind = Kind::submit;
  std::uint32_t sequence = 0;
  bool to_host = false;
  std::uint32_t endpoint = 0;
  std::uint32_t bytes = 0;              ///< submit: that follow the header, or for which there is room
  std::uint32_t victim = 0;             ///< unlink: sequence of the transfer to be given up
  std::array<std::uint8_t, 8> setup{};  ///< submit, of endpoint 0
};

/// Nothing for what is neither command.
std::optional<UsbipCommand> decode_usbip(std::span<const std::uint8_t, kUsbipHeaderBytes> header);

/// The end of a transfer: `status` is 0 or a negated errno. Towards the host, `bytes` follow the header.
UsbipHeader encode_submit_reply(std::uint32_t sequence, int status, std::uint32_t bytes);

/// `status` is -ECONNRESET when the transfer was given up, 0 when it had ended before.
UsbipHeader encode_unlink_reply(std::uint32_t sequence, int status);

}  // namespace azimuth::sim
