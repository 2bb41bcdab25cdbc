#pragma once
#include <cstdint>

#include "drivers/can/can_frame.hpp"

namespace azimuth {

/// The state of a CAN controller according to its error counters.
enum class CanBusState {
  active,
  warning,  ///< many errors
  passive,  ///< so many errors that the controller no longer signals the errors of other nodes
  off       ///< the controller does not take part in the bus until it is restarted
};

/// The word shown to users, e.g. "error-passive".
const char* text(CanBusState state);

/// The state of the bus as derived from the controller's error frames.
///
/// Thread contract: thread-bound; never allocates.
class CanBus {
 public:
  /// Takes an error frame; other frames are ignored.
  void add(const CanFrame& frame);
  /// To be called when the interface has been opened again.
  void note_opened() { state_ = CanBusState::active; }
  /// To be called when a frame has been received.
  void note_traffic();

  CanBusState state() const { return state_; }
  std::uint64_t error_frames() const { return error_frames_; }
  std::uint64_t bus_offs() const { return bus_offs_; }
  std::uint64_t restarts() const { return restarts_; }  ///< restarts of the controller after bus-off
  /// How often frames were lost because the controller's own buffer was full.
  std::uint64_t overruns() const { return overruns_; }
  /// Frames of this machine that no node acknowledged.
  std::uint64_t unacknowledged() const { return unacknowledged_; }

 private:
  void follow_controller(std::uint8_t details);

  CanBusState state_ = CanBusState::active;
  std::uint64_t error_frames_ = 0, bus_offs_ = 0, restarts_ = 0, overruns_ = 0, unacknowledged_ = 0;
};

}  // namespace azimuth
