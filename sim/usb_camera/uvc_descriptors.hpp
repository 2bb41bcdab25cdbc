#pragma once
// What a UVC 1.0 camera with one bulk endpoint says of itself: layouts as in USB 2.0, chapter 9, and the video class's
// chapter 3.
//
// Thread contract: reentrant.

#include <array>
#include <cstdint>
#include <span>

#include "sim/usb_camera/octets.hpp"
#include "sim/usb_camera/wire_image.hpp"

namespace azimuth::sim {

inline constexpr std::uint8_t kControlInterface = 0, kStreamInterface = 1;
inline constexpr std::uint8_t kImageEndpoint = 0x81;
inline constexpr std::uint16_t kBulkPacketBytes = 512;  ///< at high speed

/// The formats on offer; a format's index on the wire is its place here, from 1.
inline constexpr std::array kUvcFormats{WireFormat::yuyv, WireFormat::nv12, WireFormat::grey};

/// In the unit of the video class, 100 ns.
std::uint32_t interval_100ns(double rate_hz);

Octets uvc_device_descriptor();

/// `intervals`, shortest first, are those of every format.
Octets uvc_configuration_descriptor(int width_px, int height_px, std::span<const std::uint32_t> intervals);

/// The endpoint that every emulated camera sends its images by.
Octets image_endpoint_descriptor();

}  // namespace azimuth::sim
