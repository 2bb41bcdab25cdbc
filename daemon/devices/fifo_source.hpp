#pragma once
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/status_pace.hpp"
#include "drivers/fifo/fifo_odometer.hpp"

namespace azimuth {

/// Odometry that another program writes into a FIFO.
class FifoSource final : public Source {
 public:
  /// As FifoOdometer.
  FifoSource(const FifoSettings& settings, Duration epoch_minus_monotonic);

  const char* name() const override { return "odometer"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;
  void restore(const OdometerMemory& memory) override { odometer_.follow(memory.origin); }

 private:
  enum class Condition { unopened, silent, running };
  using Clock = FifoOdometer::Clock;

  void report(SourceWires& wires, Condition condition, Clock::time_point now);

  FifoSettings settings_;
  FifoOdometer odometer_;
  OdometryReading reading_;
  Clock::time_point silent_at_{};
  StatusPace<Condition> pace_;
  DeviceStatus status_;
};

}  // namespace azimuth
