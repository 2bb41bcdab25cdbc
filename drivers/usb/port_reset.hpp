#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "drivers/usb/usb_port.hpp"

namespace azimuth {

/// The result of a reset.
struct PortResetResult {
  bool done = false;
  std::string text;  ///< a sentence for the log, with port and cause
};

/// The last resort for a USB device that hangs: resets the device at a port, as if it were unplugged and plugged in
/// again. Usually its kernel driver releases the device and takes it again, so its nodes disappear and come back,
/// possibly under other numbers.
///
/// Requires write permission for the device's node below /dev/bus/usb, which udev rules grant.
///
/// Thread contract: thread-bound. reset() blocks for as long as the device takes, possibly seconds; the kernel offers
/// no way to interrupt it.
class PortReset {
 public:
  using Clock = std::chrono::steady_clock;
  /// Shortest time between two attempts at one port. More frequent resets would not help the device, and would keep its
  /// hub busy.
  static constexpr Clock::duration kLeastInterval = std::chrono::minutes(1);

  PortResetResult reset(const UsbPort& port, Clock::time_point now);

 private:
  struct Attempt {
    UsbPort port;
    Clock::time_point at;
  };
  bool is_too_soon(const UsbPort& port, Clock::time_point now);

  std::array<std::optional<Attempt>, 16> attempts_;  // a new attempt replaces the oldest; robots have fewer devices
};

}  // namespace azimuth
