#pragma once
#include <string>
#include <string_view>

#include "daemon/devices/usb_help.hpp"
#include "daemon/pipeline/source.hpp"

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

}  // namespace azimuth
