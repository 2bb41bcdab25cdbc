#include "tests/equipment/usb_camera/uvc_descriptors.hpp"

#include <cassert>
#include <cmath>
#include <linux/usb/ch9.h>
#include <linux/usb/video.h>
#include <string_view>

#include "tests/equipment/usb_camera/uvc_controls.hpp"

namespace azimuth::sim {
namespace {

constexpr std::uint8_t kClassSpecific = USB_TYPE_CLASS | USB_DT_INTERFACE;  // Value of bDescriptorType
constexpr std::uint16_t kUvcVersion = 0x0100;
constexpr std::uint32_t kClock_hz = 1'000'000;
constexpr std::uint8_t kFrameIndex = 1;

/// A descriptor begins with its own length, and a group of descriptors with the total length; both are written last.
void close_descriptor(Octets& into, std::size_t start) { into[start] = static_cast<std::uint8_t>(into.size() - start); }
void write_total(Octets& into, std::size_t place, std::size_t total) {
  into[place] = static_cast<std::uint8_t>(total);
  into[place + 1] = static_cast<std::uint8_t>(total >> 8U);
}

void put_u16(Octets& into, int number) { put_le(into, static_cast<std::uint16_t>(number)); }
void put_u32(Octets& into, std::size_t number) { put_le(into, static_cast<std::uint32_t>(number)); }

/// Writes the lowest `bytes` bytes of a control map, preceded by their number.
void put_map(Octets& into, std::uint32_t map, std::uint8_t bytes) {
  into.push_back(bytes);
  for (unsigned i = 0; i < bytes; ++i) into.push_back(static_cast<std::uint8_t>(map >> (8 * i)));
}

/// Writes an interface descriptor with its endpoints, class and subclass.
void put_interface(Octets& into, std::uint8_t number, std::uint8_t endpoints, std::uint8_t subclass) {
  put_octets(into,
             std::array<std::uint8_t, 9>{9, USB_DT_INTERFACE, number, 0, endpoints, USB_CLASS_VIDEO, subclass, 0, 0});
}

void put_camera_terminal(Octets& into) {
  const std::size_t start = into.size();
  put_octets(into, std::array<std::uint8_t, 4>{0, kClassSpecific, UVC_VC_INPUT_TERMINAL, kCameraTerminal});
  put_u16(into, UVC_ITT_CAMERA);
  put_octets(into, std::array<std::uint8_t, 8>{});  // No association, name or focal lengths
  put_map(into, uvc_control_map(kCameraTerminal), 3);
  close_descriptor(into, start);
}

void put_processing_unit(Octets& into) {
  const std::size_t start = into.size();
  put_octets(into,
             std::array<std::uint8_t, 5>{0, kClassSpecific, UVC_VC_PROCESSING_UNIT, kProcessingUnit, kCameraTerminal});
  put_u16(into, 0);  // No digital multiplier
  put_map(into, uvc_control_map(kProcessingUnit), 2);
  into.push_back(0);  // No name; the byte for video standards exists only from UVC 1.1 on
  close_descriptor(into, start);
}

void put_output_terminal(Octets& into) {
  put_octets(into, std::array<std::uint8_t, 9>{UVC_DT_OUTPUT_TERMINAL_SIZE, kClassSpecific, UVC_VC_OUTPUT_TERMINAL,
                                               kOutputTerminal, UVC_TT_STREAMING & 0xffU, UVC_TT_STREAMING >> 8U, 0,
                                               kProcessingUnit, 0});
}

void put_control_interface(Octets& into) {
  put_interface(into, kControlInterface, 0, UVC_SC_VIDEOCONTROL);
  const std::size_t start = into.size();
  put_octets(into, std::array<std::uint8_t, 3>{0, kClassSpecific, UVC_VC_HEADER});
  put_u16(into, kUvcVersion);
  const std::size_t total = into.size();
  put_u16(into, 0);
  put_u32(into, kClock_hz);
  put_octets(into, std::array<std::uint8_t, 2>{1, kStreamInterface});
  close_descriptor(into, start);
  put_camera_terminal(into);
  put_processing_unit(into);
  put_output_terminal(into);
  write_total(into, total, into.size() - start);
}

/// A four-letter code, followed by the part that is common to all formats.
void put_format_guid(Octets& into, WireFormat format) {
  const std::string_view code = format == WireFormat::yuyv ? "YUY2" : format == WireFormat::nv12 ? "NV12" : "Y800";
  for (const char letter : code) into.push_back(static_cast<std::uint8_t>(letter));
  put_octets(into, std::array<std::uint8_t, 12>{0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71});
}

void put_format(Octets& into, std::uint8_t index, const WireShape& shape) {
  const std::size_t start = into.size();
  put_octets(into, std::array<std::uint8_t, 5>{0, kClassSpecific, UVC_VS_FORMAT_UNCOMPRESSED, index, 1});
  put_format_guid(into, shape.format);
  into.push_back(static_cast<std::uint8_t>(shape.bits_per_pixel()));
  put_octets(into, std::array<std::uint8_t, 5>{kFrameIndex, 0, 0, 0, 0});
  close_descriptor(into, start);
}

std::size_t bits_per_second(const WireShape& shape, std::uint32_t interval) {
  return static_cast<std::size_t>(static_cast<double>(shape.bytes()) * 8e7 / interval);
}

void put_frame(Octets& into, const WireShape& shape, std::span<const std::uint32_t> intervals) {
  const std::size_t start = into.size();
  put_octets(into, std::array<std::uint8_t, 5>{0, kClassSpecific, UVC_VS_FRAME_UNCOMPRESSED, kFrameIndex, 0});
  put_u16(into, shape.width_px);
  put_u16(into, shape.height_px);
  put_u32(into, bits_per_second(shape, intervals.back()));
  put_u32(into, bits_per_second(shape, intervals.front()));
  put_u32(into, shape.bytes());
  put_le(into, intervals.front());
  into.push_back(static_cast<std::uint8_t>(intervals.size()));
  for (const std::uint32_t interval : intervals) put_le(into, interval);
  close_descriptor(into, start);
}

void put_stream_interface(Octets& into, int width_px, int height_px, std::span<const std::uint32_t> intervals) {
  put_interface(into, kStreamInterface, 1, UVC_SC_VIDEOSTREAMING);
  const std::size_t start = into.size();
  put_octets(into, std::array<std::uint8_t, 4>{0, kClassSpecific, UVC_VS_INPUT_HEADER, kUvcFormats.size()});
  const std::size_t total = into.size();
  put_u16(into, 0);
  put_octets(into, std::array<std::uint8_t, 7>{kImageEndpoint, 0, kOutputTerminal, 0, 0, 0, 1});
  put_octets(into, std::array<std::uint8_t, kUvcFormats.size()>{});  // No controls of a format
  close_descriptor(into, start);
  for (std::size_t i = 0; i < kUvcFormats.size(); ++i) {
    const WireShape shape{kUvcFormats[i], width_px, height_px};
    put_format(into, static_cast<std::uint8_t>(i + 1), shape);
    put_frame(into, shape, intervals);
  }
  write_total(into, total, into.size() - start);
  put_octets(into, image_endpoint_descriptor());
}

}  // namespace

std::uint32_t interval_100ns(double rate_hz) { return static_cast<std::uint32_t>(std::lround(1e7 / rate_hz)); }

Octets image_endpoint_descriptor() {
  return {7, USB_DT_ENDPOINT, kImageEndpoint, USB_ENDPOINT_XFER_BULK, kBulkPacketBytes & 0xffU, kBulkPacketBytes >> 8U,
          0};
}

Octets uvc_device_descriptor() {
  // Class "miscellaneous" with an interface association, as the video class requires. The ids are those of the Linux
  // Foundation's webcam gadget; strings 1 to 3.
  return {18, USB_DT_DEVICE, 0, 2, USB_CLASS_MISC, 2, 1, 64, 0x6b, 0x1d, 0x02, 0x01, 0, 1, 1, 2, 3, 1};
}

Octets uvc_configuration_descriptor(int width_px, int height_px, std::span<const std::uint32_t> intervals) {
  assert(!intervals.empty());
  Octets into{9, USB_DT_CONFIG, 0, 0, 2, 1, 0, USB_CONFIG_ATT_ONE, 250};
  put_octets(into, std::array<std::uint8_t, 8>{8, USB_DT_INTERFACE_ASSOCIATION, kControlInterface, 2, USB_CLASS_VIDEO,
                                               UVC_SC_VIDEO_INTERFACE_COLLECTION, 0, 2});
  put_control_interface(into);
  put_stream_interface(into, width_px, height_px, intervals);
  write_total(into, 2, into.size());
  return into;
}

}  // namespace azimuth::sim
