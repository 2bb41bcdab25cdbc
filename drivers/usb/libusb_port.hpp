#pragma once
// Internal to drivers/usb.

#include <array>
#include <libusb.h>
#include <optional>

#include "drivers/usb/usb_port.hpp"

namespace azimuth {

/// The port of a device; none for a root hub.
inline std::optional<UsbPort> usb_port_of(libusb_device* device) {
  std::array<std::uint8_t, UsbPort::kMaxDepth> ports{};
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  if (depth <= 0) return std::nullopt;
  return UsbPort::make(libusb_get_bus_number(device), std::span(ports).first(static_cast<std::size_t>(depth)));
}

}  // namespace azimuth
