#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <poll.h>
#include <string>

#include "daemon/devices/port_resetter.hpp"
#include "daemon/pipeline/source.hpp"
#include "drivers/usb/usb_monitor.hpp"

namespace azimuth {

/// What USB does for one source: wakes it when something is plugged in, and resets the port of its device when nothing
/// else helps. Without either (the default) it does nothing.
///
/// A device may be silent although it is sound (a robot that is switched off). Each reset in vain therefore doubles the
/// time to the next, from a minute up to `longest_interval`, until the device works again.
///
/// Thread contract: thread-bound, but made by the main thread: libusb's own thread must not take over a source's
/// real-time priority. Nothing blocks; nothing allocates while nothing happens.
class UsbHelp {
 public:
  using Clock = std::chrono::steady_clock;

  UsbHelp() = default;
  /// Null: that part is not wanted. `client` is the source's own number among the resetter's clients.
  UsbHelp(std::unique_ptr<UsbMonitor> monitor, std::shared_ptr<PortResetter> resetter, std::size_t client,
          Clock::duration longest_interval);

  /// For poll(2), with the source's own descriptors; may change with every turn.
  pollfd polled() const { return {.fd = monitor_ ? monitor_->descriptor() : -1, .events = POLLIN, .revents = 0}; }

  /// Whether something was plugged in since the last call.
  bool turn();

  /// The device works: the next reset is a first one again.
  void works() { interval_ = PortReset::kLeastInterval; }
  /// Has a port reset (as sysfs names it; empty: not by USB), unless it is too soon for that. True: it is under way.
  bool reset(const std::string& port, Clock::time_point now);
  /// Whether reset() would not be too soon.
  bool may_reset(Clock::time_point now) const {
    return resetter_ && !resetting_ && !(not_before_ && now < *not_before_);
  }
  /// Whether the reset has ended, well or not. Once for each.
  bool take_end();

  /// What there is to say in the log, oldest first.
  bool take_event(DeviceEvent& event);
  std::uint64_t resets() const { return resets_; }  ///< that were done

 private:
  std::unique_ptr<UsbMonitor> monitor_;
  std::shared_ptr<PortResetter> resetter_;
  std::size_t client_ = 0;
  Clock::duration longest_interval_{}, interval_ = PortReset::kLeastInterval;
  std::optional<Clock::time_point> not_before_;
  bool resetting_ = false, told_monitor_ = false;
  PortResetResult result_;
  std::string told_failure_;  // of the last reset; not told twice
  Ring<DeviceEvent, 4> events_;
  std::uint64_t resets_ = 0;
};

}  // namespace azimuth
