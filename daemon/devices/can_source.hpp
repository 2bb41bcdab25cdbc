#pragma once
#include "daemon/devices/event_relay.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/status_pace.hpp"
#include "drivers/can/can_driver.hpp"

namespace azimuth {

/// The odometry of a base on a CAN bus.
class CanSource final : public Source {
 public:
  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. `open_link` may lead elsewhere than to the kernel.
  CanSource(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
            CanLinkOpener open_link = CanSocket::open);

  const char* name() const override { return "odometer"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;
  void restore(const OdometerMemory& memory) override { driver_.restore(memory); }
  bool remember(OdometerMemory& out) const override { return driver_.remember(out); }
  void close() override { driver_.close(); }

 private:
  void report(SourceWires& wires);

  CanDriver driver_;
  OdometryReading reading_;
  EventRelay relay_;
  DeviceStatus status_;
  StatusPace<Connection> pace_;
};

}  // namespace azimuth
