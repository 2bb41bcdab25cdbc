#pragma once
#include "daemon/devices/background_opener.hpp"
#include "daemon/devices/polled_source.hpp"
#include "daemon/devices/usb_help.hpp"
#include "drivers/camera/camera_driver.hpp"

namespace azimuth {

/// Images of a camera that the daemon opens itself.
class CameraSource final : public PolledSource {
 public:
  /// The stamps are CLOCK_MONOTONIC plus `to_stamp`: the offset to the epoch minus the delay of the device's stamps.
  /// When a USB camera is present but silent, its port is reset, provided that `usb` can do this.
  CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb = {});

  const char* name() const override { return "camera"; }
  void restore(const OdometerMemory& /*memory*/) override {}  // a camera has no odometry

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return DeviceCondition{driver_.state().connection}; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override;
  Clock::duration due_in(Clock::time_point now) const override { return driver_.due_in(now); }
  void tell(EventRelay& relay, bool trouble, SourceWires& wires) override;

  void help(Clock::time_point now);
  void pass_on(SourceWires& wires);

  Duration to_stamp_;
  BackgroundOpener opener_;  // outlives the driver's stream
  CameraDriver driver_;
  UsbHelp usb_;
  Frame frame_;
};

}  // namespace azimuth
