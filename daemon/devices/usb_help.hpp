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

/// USB support for one source. It wakes the source when a device is plugged in, and resets the port of the source's
/// device when nothing else helps. A default-constructed object does neither.
///
/// A sound device may be silent, for example when the robot is switched off. So each unsuccessful reset doubles the
/// time to the next one, from a minute up to `longest_interval`, until the device works again.
///
/// Thread contract: thread-bound, but constructed by the main thread, because libusb's own thread must not inherit a
/// source's real-time priority. Nothing blocks; nothing allocates while there are no events.
class UsbHelp {
 public:
  using Clock = std::chrono::steady_clock;

  UsbHelp() = default;
  /// A null pointer disables that part. `client` is the source's number among the clients of the resetter.
  UsbHelp(std::unique_ptr<UsbMonitor> monitor, std::shared_ptr<PortResetter> resetter, std::size_t client,
          Clock::duration longest_interval);

  /// The entry for poll(2), beside the source's own descriptors. The entry may change with every turn.
  pollfd polled() const { return {.fd = monitor_ ? monitor_->descriptor() : -1, .events = POLLIN, .revents = 0}; }

  /// True: a device was plugged in since the last call.
  bool turn();

  /// Reports that the device works, so that the interval between resets starts again at its minimum.
  void works() { interval_ = PortReset::kLeastInterval; }
  /// Requests a reset of a port (its name in sysfs; empty: the device is not on USB), unless it is too soon. True: the
  /// reset is in progress.
  bool reset(const std::string& port, Clock::time_point now);
  /// True: a reset would not be too soon.
  bool may_reset(Clock::time_point now) const {
    return resetter_ && !resetting_ && !(not_before_ && now < *not_before_);
  }
  /// True, once for each reset: the reset has ended, with or without success.
  bool take_end();

  /// Takes the next event for the log, oldest first.
  bool take_event(DeviceEvent& event);
  std::uint64_t resets() const { return resets_; }  ///< number of resets done

 private:
  std::unique_ptr<UsbMonitor> monitor_;
  std::shared_ptr<PortResetter> resetter_;
  std::size_t client_ = 0;
  Clock::duration longest_interval_{}, interval_ = PortReset::kLeastInterval;
  std::optional<Clock::time_point> not_before_;
  bool resetting_ = false, told_monitor_ = false;
  PortResetResult result_;
  // The failure of the last reset, so that the same failure is not logged twice.
  std::string told_failure_;
  Ring<DeviceEvent, 4> events_;
  std::uint64_t resets_ = 0;
};

}  // namespace azimuth
