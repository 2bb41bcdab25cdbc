#pragma once
#include <array>
#include <optional>
#include <poll.h>
#include <string_view>

#include "daemon/devices/event_relay.hpp"
#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/source.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {

/// How a device is, as far as a change is told at once.
struct DeviceCondition {
  Connection connection = Connection::away;
  std::string_view why = {};  ///< static text; tells apart what has one word for its connection
  friend bool operator==(const DeviceCondition&, const DeviceCondition&) = default;
};
inline constexpr DeviceCondition kAway{Connection::away}, kSilent{Connection::silent}, kRunning{Connection::running};

/// What all live sources have in common: a driver that names its descriptors, has turns that never block, and knows how
/// its device is. Each turn lets it work, passes on its news, tells its status (at a change, and once a second for what
/// is counted in it), and sleeps until something comes, kNap at most.
///
/// Thread contract: as a Source. Of its own nothing allocates once storage has grown.
class PolledSource : public Source {
 public:
  using Clock = DeviceClock;

  bool turn(Doorbell& bell, SourceWires& wires) final;

 protected:
  /// What poll(2) is to wait for; a descriptor of -1 for nothing.
  using Polled = std::array<pollfd, 2>;
  static Polled only(int descriptor, short events) {
    return {pollfd{.fd = descriptor, .events = events, .revents = 0}, pollfd{.fd = -1, .events = 0, .revents = 0}};
  }

 private:
  /// Lets the driver work, and hands over what came.
  virtual void work(Clock::time_point now, SourceWires& wires) = 0;
  /// Nothing: not known yet, and nothing is told.
  virtual std::optional<DeviceCondition> condition() const = 0;
  /// All of `status` but `works`, into storage that is used again.
  virtual void describe(DeviceStatus& status) const = 0;
  virtual Polled polled() const = 0;
  /// Until the driver wants a turn without any event.
  virtual Clock::duration due_in(Clock::time_point now) const = 0;

  /// Passes on the driver's own news; `trouble`: the device does not work now.
  virtual void tell(EventRelay& /*relay*/, bool /*trouble*/, SourceWires& /*wires*/) {}
  /// Whether the driver has no news of its own, so that each change is told by the status's words.
  virtual bool status_is_news() const { return false; }

  void report(SourceWires& wires);
  void tell_change(SourceWires& wires);

  EventRelay relay_;
  DeviceStatus status_;
  DeviceEvent change_;
  StatusPace<DeviceCondition> pace_;
};

}  // namespace azimuth
