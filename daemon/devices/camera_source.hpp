#pragma once
#include "daemon/devices/background_opener.hpp"
#include "daemon/devices/event_relay.hpp"
#include "daemon/devices/usb_help.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/status_pace.hpp"
#include "drivers/camera/camera_driver.hpp"

namespace azimuth {

/// Images of a camera that belongs to the daemon, of whatever kind.
class CameraSource final : public Source {
 public:
  using Clock = CameraDriver::Clock;

  /// Stamps are CLOCK_MONOTONIC plus `to_stamp`: what is missing for the epoch, less what the device's stamps are late.
  /// A USB camera that is there but silent has its port reset, where `usb` can do that.
  CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb = {});

  const char* name() const override { return "camera"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;

 private:
  void pass_on(SourceWires& wires);
  void help(Clock::time_point now);
  void report(SourceWires& wires, Clock::time_point now);

  Duration to_stamp_;
  BackgroundOpener opener_;  // outlives the driver's stream
  CameraDriver driver_;
  UsbHelp usb_;
  Frame frame_;
  EventRelay relay_;
  DeviceStatus status_;
  StatusPace<Connection> pace_;
};

}  // namespace azimuth
