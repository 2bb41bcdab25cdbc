#pragma once
#include "daemon/devices/polled_source.hpp"
#include "drivers/fifo/fifo_odometer.hpp"

namespace azimuth {

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

}  // namespace azimuth
