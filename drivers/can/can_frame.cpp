#include "drivers/can/can_frame.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <linux/can.h>

namespace azimuth {
namespace {

static_assert(kMostCanSocketBytes == CANFD_MTU && CanFrame::kMostBytes == CANFD_MAX_DLEN);
// Both structures begin alike, with the data at the same offset.
static_assert(offsetof(can_frame, data) == offsetof(canfd_frame, data));
static_assert(offsetof(can_frame, len) == offsetof(canfd_frame, len));

CanFrame::Kind kind_of(std::uint32_t word) {
  if ((word & CAN_ERR_FLAG) != 0) return CanFrame::Kind::error;
  return (word & CAN_RTR_FLAG) != 0 ? CanFrame::Kind::remote : CanFrame::Kind::data;
}

std::uint32_t flags_of(const CanFrame& frame) {
  if (frame.kind == CanFrame::Kind::error) return CAN_ERR_FLAG;
  return (frame.id.extended ? CAN_EFF_FLAG : 0U) | (frame.kind == CanFrame::Kind::remote ? CAN_RTR_FLAG : 0U);
}

}  // namespace

std::optional<CanFrame> decode_can_frame(std::span<const std::uint8_t> datagram) {
  if (datagram.size() != CAN_MTU && datagram.size() != CANFD_MTU) return std::nullopt;
  canfd_frame raw{};
  std::memcpy(&raw, datagram.data(), datagram.size());
  CanFrame frame;
  frame.fd = datagram.size() == CANFD_MTU;
  if (raw.len > (frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return std::nullopt;
  frame.kind = kind_of(raw.can_id);
  frame.id.extended = frame.kind != CanFrame::Kind::error && (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.id.number =
      raw.can_id & (frame.id.extended || frame.kind == CanFrame::Kind::error ? CAN_EFF_MASK : CAN_SFF_MASK);
  if (frame.kind == CanFrame::Kind::remote) return frame;  // its length is that of the requested answer
  frame.size = raw.len;
  std::copy_n(raw.data, raw.len, frame.data.begin());
  return frame;
}

std::size_t encode_can_frame(const CanFrame& frame, std::span<std::uint8_t, kMostCanSocketBytes> datagram) {
  assert(frame.size <= (frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN));
  canfd_frame raw{};
  raw.can_id = frame.id.number | flags_of(frame);
  raw.len = frame.size;
  std::copy_n(frame.data.begin(), frame.size, raw.data);
  std::memcpy(datagram.data(), &raw, sizeof raw);
  return frame.fd ? CANFD_MTU : CAN_MTU;
}

}  // namespace azimuth
