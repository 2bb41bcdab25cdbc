#pragma once
// The live sources of odometry.

#include <functional>
#include <optional>
#include <string>

#include "daemon/devices/polled_source.hpp"
#include "daemon/devices/usb_help.hpp"
#include "drivers/can/can_driver.hpp"
#include "drivers/fifo/fifo_odometer.hpp"
#include "drivers/pioneer/driver.hpp"

namespace azimuth {

/// The odometry of a robot base on a CAN bus.
class CanSource final : public PolledSource {
 public:
  /// The stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. Tests pass another `open_link`.
  CanSource(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
            CanLinkOpener open_link = CanSocket::open);

  const char* name() const override { return "odometer"; }
  void restore(const OdometerMemory& memory) override { driver_.restore(memory); }
  bool remember(OdometerMemory& out) const override { return driver_.remember(out); }
  void close() override { driver_.close(); }

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return DeviceCondition{driver_.state().connection}; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override { return only(driver_.descriptor(), driver_.poll_events()); }
  Clock::duration due_in(Clock::time_point now) const override { return driver_.due_in(now); }
  void tell(EventRelay& relay, bool trouble, SourceWires& wires) override {
    relay.pass_on(driver_, trouble, "", wires);
  }

  CanDriver driver_;
  OdometryReading reading_;
};

/// The odometry that another program writes into a FIFO.
class FifoSource final : public PolledSource {
 public:
  /// Parameters as for FifoOdometer.
  FifoSource(const FifoSettings& settings, Duration epoch_minus_monotonic);

  const char* name() const override { return "odometer"; }
  void restore(const OdometerMemory& memory) override { odometer_.follow(memory.origin); }

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return DeviceCondition{odometer_.state().connection}; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override { return only(odometer_.descriptor(), POLLIN); }
  Clock::duration due_in(Clock::time_point now) const override { return odometer_.due_in(now); }
  void tell(EventRelay& relay, bool trouble, SourceWires& wires) override {
    relay.pass_on(odometer_, trouble, "", wires);
  }

  std::string path_;
  FifoOdometer odometer_;
  OdometryReading reading_;
};

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
