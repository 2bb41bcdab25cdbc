#pragma once
#include <array>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>

#include "daemon/devices/usb_help.hpp"
#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/source.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// Passes the news of a device on to the log. News that finds no room on the wire is lost.
///
/// Thread contract: thread-bound. Nothing allocates once the storage has grown.
class EventRelay {
 public:
  /// Passes on all news of the driver, each with `prefix` before it. `trouble`: the device does not work now.
  template <class Driver>
  void pass_on(Driver& driver, bool trouble, std::string_view prefix, SourceWires& wires) {
    while (driver.take_event(text_)) {
      event_.trouble = trouble;
      event_.text.assign(prefix).append(text_);
      event_.port_reset = false;
      wires.events.push(event_);
    }
  }
  /// Passes on all news of the device's USB port, each with `prefix` before it.
  void pass_on(UsbHelp& usb, std::string_view prefix, SourceWires& wires) {
    while (usb.take_event(event_)) {
      event_.text.insert(0, prefix);
      wires.events.push(event_);
    }
  }

 private:
  std::string text_;
  DeviceEvent event_;
};

/// The state of a device. A change of it is reported at once.
struct DeviceCondition {
  Connection connection = Connection::away;
  /// Static text. It distinguishes conditions that have the same connection.
  std::string_view why = {};
  friend bool operator==(const DeviceCondition&, const DeviceCondition&) = default;
};
inline constexpr DeviceCondition kAway{Connection::away}, kSilent{Connection::silent}, kRunning{Connection::running};

/// The common base of all live sources. Each has a driver that names its descriptors, never blocks in a turn, and knows
/// the state of its device. Each turn lets the driver work, passes on its news, publishes its status (when the
/// condition changes, and once a second for the counters), and sleeps until data arrive, kNap at most.
///
/// Thread contract: as for Source. This class allocates nothing once the storage has grown.
class PolledSource : public Source {
 public:
  using Clock = DeviceClock;

  bool turn(Doorbell& bell, SourceWires& wires) final;

 protected:
  /// Descriptors and events that poll(2) waits for; an unused entry has the descriptor -1.
  using Polled = std::array<pollfd, 2>;
  static Polled only(int descriptor, short events) {
    return {pollfd{.fd = descriptor, .events = events, .revents = 0}, pollfd{.fd = -1, .events = 0, .revents = 0}};
  }

 private:
  /// Lets the driver work, and sends the samples that arrived.
  virtual void work(Clock::time_point now, SourceWires& wires) = 0;
  /// None: the condition is not known yet, and nothing is reported.
  virtual std::optional<DeviceCondition> condition() const = 0;
  /// Fills in all of `status` except `works`. The storage of `status` is reused.
  virtual void describe(DeviceStatus& status) const = 0;
  virtual Polled polled() const = 0;
  /// Time until the driver needs a turn without any event.
  virtual Clock::duration due_in(Clock::time_point now) const = 0;

  /// Passes on the driver's own news. `trouble`: the device does not work now.
  virtual void tell(EventRelay& /*relay*/, bool /*trouble*/, SourceWires& /*wires*/) {}
  /// True: the driver has no news of its own, so each change is logged with the words of the status.
  virtual bool status_is_news() const { return false; }

  void report(SourceWires& wires);
  void tell_change(SourceWires& wires);

  EventRelay relay_;
  DeviceStatus status_;
  DeviceEvent change_;
  StatusPace<DeviceCondition> pace_;
};

}  // namespace azimuth
