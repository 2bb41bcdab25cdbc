#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "drivers/usb/usb_port.hpp"

namespace azimuth {

/// What became of a reset.
struct PortResetResult {
  bool done = false;
  std::string text;  ///< a sentence for the log, with port and reason
};

/// The last resort for a USB device that hangs: resets what is plugged in at a port, as if it were unplugged and
/// plugged in again. Its kernel driver usually lets go of it and takes it anew, so that its nodes go and come back,
/// perhaps under other numbers.
///
/// Needs write permission to the device's node below /dev/bus/usb, which udev rules give.
///
/// Thread contract: thread-bound. reset() blocks while the device takes its time, which can be seconds; nothing in the
/// kernel lets that be cut short.
class PortReset {
 public:
  using Clock = std::chrono::steady_clock;
  /// Between two attempts at one port: a device that needs more is not to be helped, and must not keep its hub busy.
  static constexpr Clock::duration kLeastInterval = std::chrono::minutes(1);

  PortResetResult reset(const UsbPort& port, Clock::time_point now);

 private:
  struct Attempt {
    UsbPort port;
    Clock::time_point at;
  };
  bool is_too_soon(const UsbPort& port, Clock::time_point now);

  std::array<std::optional<Attempt>, 16> attempts_;  // the oldest gives way: robots have fewer devices
};

}  // namespace azimuth
