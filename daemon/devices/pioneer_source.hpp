#pragma once
#include <functional>
#include <optional>
#include <string>

#include "daemon/devices/polled_source.hpp"
#include "daemon/devices/usb_help.hpp"
#include "drivers/pioneer/driver.hpp"

namespace azimuth {

/// How a serial adapter can be reset through USB.
struct AdapterHelp {
  UsbHelp usb;
  std::chrono::duration<double> reset_after = std::chrono::seconds(10);  ///< silence after which the port is reset
  /// Finds the USB port of the adapter at a device node. Tests pass another function.
  std::function<std::optional<UsbPort>(const std::string& node)> find_port = [](const std::string& node) {
    return usb_port_of_node(node);
  };
};

/// The wheel odometry of a Pioneer on its serial line.
///
/// When a USB adapter is present but sends not a single byte, it is closed and its port is reset. Either the adapter
/// hangs, or the robot is switched off; these look the same, and the reset does no harm in the second case (UsbHelp
/// limits how often).
class PioneerSource final : public PolledSource {
 public:
  /// The stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  PioneerSource(const PioneerSettings& settings, Duration epoch_minus_monotonic, AdapterHelp help = {});

  const char* name() const override { return "odometer"; }
  void restore(const OdometerMemory& memory) override { driver_.restore(memory); }
  bool remember(OdometerMemory& out) const override { return driver_.remember(out); }
  void close() override;

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return DeviceCondition{driver_.state().connection}; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override;
  Clock::duration due_in(Clock::time_point now) const override { return driver_.due_in(now); }
  void tell(EventRelay& relay, bool trouble, SourceWires& wires) override;

  void help(Clock::time_point now);
  void find_port();

  std::string device_;
  PioneerDriver driver_;
  AdapterHelp help_;
  // USB port of the adapter when it was last opened; empty: unknown.
  std::string port_;
  int descriptor_ = -1;  // descriptor of the last turn
  OdometryReading reading_;
};

}  // namespace azimuth
