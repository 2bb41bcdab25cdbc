#pragma once
#include <string>
#include <string_view>

#include "daemon/devices/usb_help.hpp"
#include "daemon/pipeline/source.hpp"

namespace azimuth {

/// Passes on to the log what there is to say of a device. What finds no room on the wire is lost.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown.
class EventRelay {
 public:
  /// Everything that the driver has to tell, each after `prefix`. `trouble`: the device does not work now.
  template <class Driver>
  void pass_on(Driver& driver, bool trouble, std::string_view prefix, SourceWires& wires) {
    while (driver.take_event(text_)) {
      event_.trouble = trouble;
      event_.text.assign(prefix).append(text_);
      event_.port_reset = false;
      wires.events.push(event_);
    }
  }
  /// Likewise of its USB port.
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
