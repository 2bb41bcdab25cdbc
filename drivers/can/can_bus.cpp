#include "drivers/can/can_bus.hpp"

#include <linux/can/error.h>

namespace azimuth {

const char* text(CanBusState state) {
  switch (state) {
    case CanBusState::active:
      return "error-active";
    case CanBusState::warning:
      return "error-warning";
    case CanBusState::passive:
      return "error-passive";
    case CanBusState::off:
      return "bus-off";
  }
  return "";
}

void CanBus::add(const CanFrame& frame) {
  if (frame.kind != CanFrame::Kind::error) return;
  ++error_frames_;
  const std::uint32_t classes = frame.id.number;
  if ((classes & CAN_ERR_ACK) != 0) ++unacknowledged_;
  if ((classes & CAN_ERR_CRTL) != 0 && frame.size > 1) follow_controller(frame.data[1]);
  if ((classes & CAN_ERR_RESTARTED) != 0) {
    ++restarts_;
    state_ = CanBusState::active;
  }
  if ((classes & CAN_ERR_BUSOFF) != 0) {
    ++bus_offs_;
    state_ = CanBusState::off;
  }
}

void CanBus::follow_controller(std::uint8_t details) {
  if ((details & CAN_ERR_CRTL_RX_OVERFLOW) != 0) ++overruns_;
  if ((details & CAN_ERR_CRTL_ACTIVE) != 0) state_ = CanBusState::active;
  if ((details & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0) state_ = CanBusState::warning;
  if ((details & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) state_ = CanBusState::passive;
}

/// Traffic shows a restart, because not every driver reports it.
void CanBus::note_traffic() {
  if (state_ == CanBusState::off) state_ = CanBusState::active;
}

}  // namespace azimuth
