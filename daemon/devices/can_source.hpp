#pragma once
#include "daemon/devices/polled_source.hpp"
#include "drivers/can/can_driver.hpp"

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

}  // namespace azimuth
