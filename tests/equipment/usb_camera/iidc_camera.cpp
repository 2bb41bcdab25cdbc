#include "tests/equipment/usb_camera/iidc_camera.hpp"

#include <algorithm>
#include <array>
#include <linux/usb/ch9.h>
#include <utility>

#include "tests/equipment/usb_camera/uvc_descriptors.hpp"

namespace azimuth::sim {
namespace {

constexpr std::uint8_t kRegisterRequest = 0x7f;

}  // namespace

IidcCamera::IidcCamera(std::uint64_t guid, std::string serial)
    : EmulatedCamera("Virtual IIDC", std::move(serial)), registers_(guid) {}

WireShape IidcCamera::shape() const {
  if (registers_.mode() == iidc::kModeYuv422_320x240) return {WireFormat::uyvy, 320, 240};
  return {WireFormat::grey, 640, 480};
}

Octets IidcCamera::device_descriptor() const {
  // Vendor-specific class, with ids that libdc1394 recognises as a camera.
  return {18, USB_DT_DEVICE, 0, 2, USB_CLASS_VENDOR_SPEC, 0, 0, 64, 0x10, 0x1e, 0x04, 0x20, 0, 1, 1, 2, 3, 1};
}

Octets IidcCamera::configuration_descriptor() const {
  constexpr std::uint8_t kTotal = 9 + 9 + 7;
  Octets into{9, USB_DT_CONFIG, kTotal, 0, 1, 1, 0, USB_CONFIG_ATT_ONE, 250};
  put_octets(into, std::array<std::uint8_t, 9>{9, USB_DT_INTERFACE, 0, 0, 1, USB_CLASS_VENDOR_SPEC, 0, 0, 0});
  put_octets(into, image_endpoint_descriptor());
  return into;
}

ControlAnswer IidcCamera::own_request(const ControlRequest& request, OctetSpan data) {
  if ((request.type & ~USB_DIR_IN) != USB_TYPE_VENDOR || request.request != kRegisterRequest) return std::nullopt;
  const std::uint32_t address = std::uint32_t{request.index} << 16U | request.value;
  return request.to_host() ? read_registers(address, request.length) : write_registers(address, data);
}

ControlAnswer IidcCamera::read_registers(std::uint32_t address, std::size_t bytes) const {
  Octets quadlets;
  for (std::uint32_t i = 0; i + 4 <= bytes; i += 4) {
    const std::optional<std::uint32_t> value = registers_.read(address + i);
    if (!value) return std::nullopt;
    put_le(quadlets, *value);
  }
  return quadlets;
}

ControlAnswer IidcCamera::write_registers(std::uint32_t address, OctetSpan data) {
  for (std::uint32_t i = 0; i + 4 <= data.size(); i += 4) {
    if (!registers_.write(address + i, static_cast<std::uint32_t>(get_le(data.subspan(i), 4)))) return std::nullopt;
  }
  if (registers_.streaming() && !streaming()) start_streaming();
  if (!registers_.streaming() && streaming()) stop_streaming();
  return Octets{};
}

std::size_t IidcCamera::pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) {
  answer.failed = std::exchange(fails_, false);
  if (answer.failed) return unsent.size();
  const OctetSpan carried = unsent.first(std::min(unsent.size(), room));
  put_octets(answer.bytes, carried);
  return carried.size();
}

}  // namespace azimuth::sim
