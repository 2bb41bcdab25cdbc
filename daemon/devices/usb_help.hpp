#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <poll.h>
#include <string>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/stage_thread.hpp"
#include "daemon/pipeline/wires.hpp"
#include "drivers/usb/port_reset.hpp"
#include "drivers/usb/usb_monitor.hpp"

namespace azimuth {

/// Resets USB ports on a thread of its own, so that no source waits for a reset.
///
/// Thread contract: constructed and destroyed by one thread; each client number belongs to one thread. The destructor
/// waits for a reset in progress. The end of the process would wait as well, because the kernel does not interrupt a
/// reset.
class PortResetter {
 public:
  static constexpr std::size_t kClients = 2;  ///< number of sources that can request resets
  using Reset = std::function<PortResetResult(const UsbPort& port, PortReset::Clock::time_point now)>;

  /// Tests pass another `reset`. Throws std::system_error when the system refuses a thread.
  PortResetter();
  explicit PortResetter(Reset reset);
  ~PortResetter();
  PortResetter(const PortResetter&) = delete;
  PortResetter& operator=(const PortResetter&) = delete;

  /// Requests a reset and returns at once. The new request replaces an earlier one that has not been processed
  /// yet.
  void request(std::size_t client, const UsbPort& port);
  /// Takes the result of the client's last request, once. False: there is no new one.
  bool take(std::size_t client, PortResetResult& into);

 private:
  struct Lane {
    explicit Lane(Doorbell& resetter, Doorbell& client) : wishes(resetter), results(client) {}
    Newest<std::optional<UsbPort>> wishes;
    Newest<PortResetResult> results;
  };
  void turn();

  Doorbell bell_, nobodys_bell_;  // clients poll often enough for results and need no bell
  Reset reset_;
  std::array<Lane, kClients> lanes_;
  std::atomic<bool> ends_{false};
  StageThread thread_;  // declared last, so that it ends before the members it uses are destroyed
};

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
