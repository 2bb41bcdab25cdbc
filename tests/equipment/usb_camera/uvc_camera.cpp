#include "tests/equipment/usb_camera/uvc_camera.hpp"

#include <algorithm>
#include <linux/usb/ch9.h>
#include <linux/usb/video.h>
#include <utility>

#include "tests/equipment/usb_camera/uvc_descriptors.hpp"

namespace azimuth::sim {
namespace {

constexpr std::size_t kProbeBytes = 26;  // Of UVC 1.0
constexpr std::size_t kProbeFormat = 2, kProbeInterval = 4, kProbeImageBytes = 18;

bool is_to_interface(const ControlRequest& request) {
  return (request.type & ~USB_DIR_IN) == (USB_TYPE_CLASS | USB_RECIP_INTERFACE);
}

}  // namespace

UvcCamera::UvcCamera(int width_px, int height_px, double rate_hz, std::string serial)
    : EmulatedCamera("Virtual UVC", std::move(serial)),
      width_px_(width_px),
      height_px_(height_px),
      intervals_{interval_100ns(rate_hz), interval_100ns(rate_hz / 2)},
      interval_(intervals_.front()) {}

WireShape UvcCamera::shape() const { return {kUvcFormats.at(format_), width_px_, height_px_}; }

Octets UvcCamera::device_descriptor() const { return uvc_device_descriptor(); }

Octets UvcCamera::configuration_descriptor() const {
  return uvc_configuration_descriptor(width_px_, height_px_, intervals_);
}

void UvcCamera::at_power_up() {
  controls_.reset();
  format_ = 0;
  interval_ = intervals_.front();
  flags_ = 0;
  payload_left_ = payload_bytes_ = 0;
  owes_empty_ = false;
}

ControlAnswer UvcCamera::own_request(const ControlRequest& request, OctetSpan data) {
  if (!is_to_interface(request)) return std::nullopt;
  if (request.index_low() == kControlInterface) return controls_.request(request, data);
  if (request.index_low() == kStreamInterface) return stream_request(request, data);
  return std::nullopt;
}

/// Handles probe (negotiation) and commit (start of the stream). Both share one state, since hosts commit what they
/// probed.
ControlAnswer UvcCamera::stream_request(const ControlRequest& request, OctetSpan data) {
  const bool commit = request.value_high() == UVC_VS_COMMIT_CONTROL;
  if (!commit && request.value_high() != UVC_VS_PROBE_CONTROL) return std::nullopt;
  switch (request.request) {
    case UVC_SET_CUR:
      if (request.to_host() || data.size() < kProbeBytes) return std::nullopt;
      negotiate(data);
      if (commit) start_streaming();
      if (commit) payload_left_ = payload_bytes_ = 0;
      if (commit) owes_empty_ = false;
      return Octets{};
    case UVC_GET_CUR:
    case UVC_GET_MIN:
    case UVC_GET_MAX:
    case UVC_GET_DEF:
      return agreement();
    case UVC_GET_LEN:
      return Octets{kProbeBytes, 0};
    case UVC_GET_INFO:
      return Octets{UVC_CONTROL_CAP_GET | UVC_CONTROL_CAP_SET};
    default:
      return std::nullopt;
  }
}

/// Replaces values that are not available by available ones: the first format, the slowest rate.
void UvcCamera::negotiate(OctetSpan wanted) {
  const std::size_t format = wanted[kProbeFormat];
  format_ = format >= 1 && format <= kUvcFormats.size() ? format - 1 : 0;
  const auto interval = static_cast<std::uint32_t>(get_le(wanted.subspan(kProbeInterval), 4));
  const auto found = std::ranges::find_if(intervals_, [&](std::uint32_t one) { return one >= interval; });
  interval_ = found != intervals_.end() ? *found : intervals_.back();
}

Octets UvcCamera::agreement() const {
  Octets probe{1, 0, static_cast<std::uint8_t>(format_ + 1), 1};
  put_le(probe, interval_);
  probe.resize(kProbeImageBytes);
  put_le(probe, static_cast<std::uint32_t>(shape().bytes()));
  put_le(probe, static_cast<std::uint32_t>(kMaxPayloadBytes));
  return probe;
}

void UvcCamera::at_image(ImageFlaw flaw) {
  const std::uint8_t next = ~flags_ & UVC_STREAM_FID;
  flags_ = static_cast<std::uint8_t>(UVC_STREAM_EOH | next | (flaw == ImageFlaw::marked_bad ? UVC_STREAM_ERR : 0));
}

std::size_t UvcCamera::pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) {
  if (std::exchange(owes_empty_, false)) return 0;
  if (payload_left_ == 0) {
    if (room < kHeaderBytes) return 0;
    const std::size_t carried = std::min(unsent.size(), kMaxPayloadBytes - kHeaderBytes);
    const bool last = carried == unsent.size();
    answer.bytes = {kHeaderBytes, static_cast<std::uint8_t>(flags_ | (last ? UVC_STREAM_EOF : 0))};
    payload_left_ = carried;
    payload_bytes_ = kHeaderBytes;
  }
  const std::size_t carried = std::min(payload_left_, room - answer.bytes.size());
  put_octets(answer.bytes, unsent.first(carried));
  payload_left_ -= carried;
  payload_bytes_ += carried;
  owes_empty_ = payload_left_ == 0 && answer.bytes.size() == room && payload_bytes_ < kMaxPayloadBytes;
  return carried;
}

}  // namespace azimuth::sim
