#pragma once
#include <cstdint>

#include "drivers/can/can_frame.hpp"

namespace azimuth {

/// How a CAN controller takes part in the bus, by its error counters.
enum class CanBusState {
  active,
  warning,  ///< many errors
  passive,  ///< so many that it no longer signals those of others
  off       ///< it takes no part until it is started again
};

/// The word a user reads, e.g. "error-passive".
const char* text(CanBusState state);

/// What the controller's error frames tell.
///
/// Thread contract: thread-bound; never allocates.
class CanBus {
 public:
  /// An error frame; others are ignored.
  void add(const CanFrame& frame);
  /// The interface was opened anew.
  void note_opened() { state_ = CanBusState::active; }
  /// A frame came through.
  void note_traffic();

  CanBusState state() const { return state_; }
  std::uint64_t error_frames() const { return error_frames_; }
  std::uint64_t bus_offs() const { return bus_offs_; }
  std::uint64_t restarts() const { return restarts_; }  ///< of the controller, after bus-off
  std::uint64_t overruns() const { return overruns_; }  ///< the controller's own buffer was full: frames are lost
  std::uint64_t unacknowledged() const { return unacknowledged_; }  ///< frames of this machine that nobody heard

 private:
  void follow_controller(std::uint8_t details);

  CanBusState state_ = CanBusState::active;
  std::uint64_t error_frames_ = 0, bus_offs_ = 0, restarts_ = 0, overruns_ = 0, unacknowledged_ = 0;
};

}  // namespace azimuth
