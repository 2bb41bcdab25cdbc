#pragma once
// The descriptors of a UVC 1.0 camera with one bulk endpoint. Layouts follow USB 2.0, chapter 9, and chapter 3 of the
// video class specification.
//
// Thread contract: reentrant.

#include <array>
#include <cstdint>
#include <span>

#include "tests/equipment/usb_camera/octets.hpp"
#include "tests/equipment/usb_camera/wire_image.hpp"

namespace azimuth::sim {

inline constexpr std::uint8_t kControlInterface = 0, kStreamInterface = 1;
inline constexpr std::uint8_t kImageEndpoint = 0x81;
inline constexpr std::uint16_t kBulkPacketBytes = 512;  ///< At high speed

/// The available formats; a format's index on the wire is its index here plus 1.
inline constexpr std::array kUvcFormats{WireFormat::yuyv, WireFormat::nv12, WireFormat::grey};

/// Converts a rate to a frame interval in the video class's unit of 100 ns.
std::uint32_t interval_100ns(double rate_hz);

Octets uvc_device_descriptor();

/// `intervals`, shortest first, apply to every format.
Octets uvc_configuration_descriptor(int width_px, int height_px, std::span<const std::uint32_t> intervals);

/// The endpoint by which all emulated cameras send images.
Octets image_endpoint_descriptor();

}  // namespace azimuth::sim
