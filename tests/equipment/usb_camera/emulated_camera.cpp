#include "tests/equipment/usb_camera/emulated_camera.hpp"

#include <array>
#include <cassert>
#include <string_view>

namespace azimuth::sim {
namespace {

// Requests of USB 2.0, section 9.4.
constexpr std::uint8_t kGetStatus = 0, kClearFeature = 1, kSetFeature = 3, kGetDescriptor = 6, kGetConfiguration = 8,
                       kSetConfiguration = 9, kGetInterface = 10, kSetInterface = 11;
constexpr std::uint8_t kDevice = 1, kConfiguration = 2, kString = 3;
constexpr std::uint8_t kKindMask = 0x60, kRecipientMask = 0x1f, kToEndpoint = 2;
constexpr Octets::value_type kEnglish[] = {4, kString, 0x09, 0x04};

Octets string_descriptor(std::string_view text) {
  Octets descriptor{static_cast<std::uint8_t>(2 + 2 * text.size()), kString};
  for (const char letter : text) put_octets(descriptor, std::array{static_cast<std::uint8_t>(letter), std::uint8_t{0}});
  return descriptor;
}

}  // namespace

std::optional<ControlRequest> parse_setup(OctetSpan setup) {
  if (setup.size() != kSetupBytes) return std::nullopt;
  const auto word = [&](std::size_t offset) { return static_cast<std::uint16_t>(get_le(setup.subspan(offset), 2)); };
  return ControlRequest{.type = setup[0], .request = setup[1], .value = word(2), .index = word(4), .length = word(6)};
}

ControlAnswer EmulatedCamera::control(const ControlRequest& request, OctetSpan data) {
  const bool standard = (request.type & kKindMask) == 0;
  ControlAnswer answer = standard ? standard_request(request) : own_request(request, data);
  if (answer && answer->size() > request.length) answer->resize(request.length);
  return answer;
}

ControlAnswer EmulatedCamera::standard_request(const ControlRequest& request) {
  const bool to_endpoint = (request.type & kRecipientMask) == kToEndpoint;
  switch (request.request) {
    case kGetDescriptor:
      return request.to_host() ? descriptor(request) : std::nullopt;
    case kGetStatus:
      return request.to_host() ? ControlAnswer(Octets{0, 0}) : std::nullopt;
    case kGetConfiguration:
      return request.to_host() ? ControlAnswer(Octets{1}) : std::nullopt;
    case kGetInterface:
      return request.to_host() ? ControlAnswer(Octets{0}) : std::nullopt;
    case kSetConfiguration:
      return request.to_host() ? std::nullopt : set_configuration();
    case kClearFeature:  // For the endpoint: hosts end a video stream without alternate settings in this way
      if (to_endpoint) stop_streaming();
      [[fallthrough]];
    case kSetFeature:
    case kSetInterface:
      return request.to_host() ? std::nullopt : ControlAnswer(Octets{});
    default:
      return std::nullopt;
  }
}

ControlAnswer EmulatedCamera::descriptor(const ControlRequest& request) {
  switch (request.value_high()) {
    case kDevice:
      enumerating_ = true;
      return device_descriptor();
    case kConfiguration:
      if (request.value_low() != 0) return std::nullopt;
      return configuration_descriptor();
    case kString:
      switch (request.value_low()) {
        case 0:
          return Octets(std::begin(kEnglish), std::end(kEnglish));
        case 1:
          return string_descriptor("Azimuth");
        case 2:
          return string_descriptor(product_);
        case 3:
          return string_descriptor(serial_);
        default:
          return std::nullopt;
      }
    default:
      return std::nullopt;
  }
}

/// vhci_hcd does not report a port reset to the device. The device recognises a reset by the fact that the host reads
/// its descriptors and then configures it. Programs that only configure it again (libdc1394 does) do not end a hang.
ControlAnswer EmulatedCamera::set_configuration() {
  stop_streaming();
  at_configuration();
  if (enumerating_) {
    ++resets_;
    hung_ = false;
  }
  enumerating_ = false;
  return Octets{};
}

std::optional<BulkAnswer> EmulatedCamera::next_transfer(std::size_t room) {
  const bool pending = sent_ < image_.size() || owes_transfer();
  if (!streaming_ || frozen_ || hung_ || !pending) return std::nullopt;
  BulkAnswer answer;
  sent_ += pack(from_offset(image_, sent_), room, answer);
  assert(sent_ <= image_.size() && answer.bytes.size() <= room);
  return answer;
}

void EmulatedCamera::begin_image(OctetSpan image, ImageFlaw flaw) {
  assert(ready());
  image_.assign(image.begin(), image.end());
  sent_ = 0;
  at_image(flaw);
  if (flaw == ImageFlaw::cut_short) image_.resize(image_.size() / 2);
}

void EmulatedCamera::start_streaming() {
  stop_streaming();
  streaming_ = true;
}

void EmulatedCamera::stop_streaming() {
  streaming_ = false;
  image_.clear();
  sent_ = 0;
}

void EmulatedCamera::power_up() {
  stop_streaming();
  frozen_ = hung_ = enumerating_ = false;
  at_power_up();
}

}  // namespace azimuth::sim
