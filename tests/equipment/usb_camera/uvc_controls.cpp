#include "tests/equipment/usb_camera/uvc_controls.hpp"

#include <algorithm>
#include <linux/usb/video.h>

namespace azimuth::sim {
namespace {

constexpr std::uint8_t kGetAndSet = UVC_CONTROL_CAP_GET | UVC_CONTROL_CAP_SET;
/// Bits of the exposure mode: manual, and aperture priority, the usual automatic mode of webcams.
constexpr std::int32_t kManual = 1, kAperturePriority = 8;

constexpr UvcControl plain(std::uint8_t entity, std::uint8_t selector, std::uint8_t bytes, std::uint8_t map_bit,
                           std::array<std::int32_t, 4> range) {
  return {entity, selector, bytes, map_bit, range[0], range[1], range[2], range[3], 0, 0, false};
}
constexpr UvcControl switched(UvcControl control, std::uint8_t automatic, std::int32_t manual) {
  control.automatic = automatic;
  control.manual = manual;
  return control;
}

// A range is minimum, maximum, step, initial value. Exposure is in 0.1 ms, white balance in K.
constexpr std::array kControls{
    UvcControl{kCameraTerminal, UVC_CT_AE_MODE_CONTROL, 1, 1, kManual, kAperturePriority, kManual | kAperturePriority,
               kAperturePriority, 0, 0, true},
    switched(plain(kCameraTerminal, UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL, 4, 3, {1, 5000, 1, 157}),
             UVC_CT_AE_MODE_CONTROL, kManual),
    switched(plain(kCameraTerminal, UVC_CT_FOCUS_ABSOLUTE_CONTROL, 2, 5, {0, 250, 5, 30}), UVC_CT_FOCUS_AUTO_CONTROL,
             0),
    plain(kCameraTerminal, UVC_CT_FOCUS_AUTO_CONTROL, 1, 17, {0, 1, 1, 1}),
    plain(kProcessingUnit, UVC_PU_BRIGHTNESS_CONTROL, 2, 0, {-64, 64, 1, 0}),
    plain(kProcessingUnit, UVC_PU_GAIN_CONTROL, 2, 9, {0, 255, 1, 64}),
    switched(plain(kProcessingUnit, UVC_PU_WHITE_BALANCE_TEMPERATURE_CONTROL, 2, 6, {2800, 6500, 1, 4600}),
             UVC_PU_WHITE_BALANCE_TEMPERATURE_AUTO_CONTROL, 0),
    plain(kProcessingUnit, UVC_PU_WHITE_BALANCE_TEMPERATURE_AUTO_CONTROL, 1, 12, {0, 1, 1, 1}),
};

std::size_t find(std::uint8_t entity, std::uint8_t selector) {
  const auto found = std::ranges::find_if(
      kControls, [&](const UvcControl& one) { return one.entity == entity && one.selector == selector; });
  return static_cast<std::size_t>(found - kControls.begin());
}

Octets as_octets(std::int32_t value, std::uint8_t bytes) {
  Octets octets;
  put_le(octets, static_cast<std::uint32_t>(value));
  octets.resize(bytes);
  return octets;
}

std::int32_t as_number(const UvcControl& control, OctetSpan data) {
  const auto raw = static_cast<std::uint32_t>(get_le(data, control.bytes));
  const bool negative = control.minimum < 0 && (raw >> (8U * control.bytes - 1U) & 1U) != 0;
  const bool extend = negative && control.bytes < sizeof raw;
  return static_cast<std::int32_t>(extend ? raw | ~0U << 8U * control.bytes : raw);
}

bool is_allowed(const UvcControl& control, std::int32_t value) {
  if (control.is_mask) return (value == kManual || value == kAperturePriority) && (value & ~control.step) == 0;
  return value >= control.minimum && value <= control.maximum;
}

}  // namespace

std::span<const UvcControl> uvc_controls() { return kControls; }

std::uint32_t uvc_control_map(std::uint8_t entity) {
  std::uint32_t map = 0;
  for (const UvcControl& control : kControls) {
    if (control.entity == entity) map |= 1U << control.map_bit;
  }
  return map;
}

void UvcControlBank::reset() {
  static_assert(kControls.size() <= kMostControls);
  for (std::size_t i = 0; i < kControls.size(); ++i) values_[i] = kControls[i].initial;
  refusal_ = UvcRefusal::none;
}

std::int32_t UvcControlBank::value(std::uint8_t entity, std::uint8_t selector) const {
  return values_.at(find(entity, selector));
}

ControlAnswer UvcControlBank::refuse(UvcRefusal why) {
  refusal_ = why;
  return std::nullopt;
}

ControlAnswer UvcControlBank::request(const ControlRequest& request, OctetSpan data) {
  const std::uint8_t entity = request.index_high(), selector = request.value_high();
  if (entity == 0) {  // Reading the reason does not change it
    const bool asks_why = selector == UVC_VC_REQUEST_ERROR_CODE_CONTROL && request.request == UVC_GET_CUR;
    return asks_why ? ControlAnswer(Octets{static_cast<std::uint8_t>(refusal_)}) : std::nullopt;
  }
  if (entity > kProcessingUnit) return refuse(UvcRefusal::invalid_unit);
  const std::size_t index = find(entity, selector);
  if (index == kControls.size()) return refuse(UvcRefusal::invalid_control);
  ControlAnswer answer = request.to_host()                ? get(index, request.request)
                         : request.request == UVC_SET_CUR ? set(index, data)
                                                          : refuse(UvcRefusal::invalid_request);
  if (answer) refusal_ = UvcRefusal::none;
  return answer;
}

bool UvcControlBank::is_automatic(const UvcControl& control) const {
  return control.automatic != 0 && value(control.entity, control.automatic) != control.manual;
}

ControlAnswer UvcControlBank::get(std::size_t index, std::uint8_t request) {
  const UvcControl& control = kControls[index];
  const std::uint8_t disabled = is_automatic(control) ? UVC_CONTROL_CAP_DISABLED : 0;
  switch (request) {
    case UVC_GET_CUR:
      return as_octets(values_[index], control.bytes);
    case UVC_GET_MIN:
      return as_octets(control.minimum, control.bytes);
    case UVC_GET_MAX:
      return as_octets(control.maximum, control.bytes);
    case UVC_GET_RES:
      return as_octets(control.step, control.bytes);
    case UVC_GET_DEF:
      return as_octets(control.initial, control.bytes);
    case UVC_GET_LEN:
      return as_octets(control.bytes, 2);
    case UVC_GET_INFO:
      return Octets{static_cast<std::uint8_t>(kGetAndSet | disabled)};
    default:
      return refuse(UvcRefusal::invalid_request);
  }
}

ControlAnswer UvcControlBank::set(std::size_t index, OctetSpan data) {
  const UvcControl& control = kControls[index];
  if (data.size() != control.bytes) return refuse(UvcRefusal::invalid_request);
  const std::int32_t value = as_number(control, data);
  if (is_automatic(control)) return refuse(UvcRefusal::wrong_state);
  if (!is_allowed(control, value)) return refuse(UvcRefusal::out_of_range);
  values_[index] = value;
  return Octets{};
}

}  // namespace azimuth::sim
