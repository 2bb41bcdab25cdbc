#pragma once
#include "daemon/pipeline/source.hpp"
#include "drivers/pioneer/driver.hpp"

namespace azimuth {

/// The wheel odometry of a Pioneer on its serial line.
class PioneerSource final : public Source {
 public:
  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  PioneerSource(const PioneerSettings& settings, Duration epoch_minus_monotonic);

  const char* name() const override { return "odometer"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;
  void close() override;

 private:
  void report(SourceWires& wires);

  PioneerDriver driver_;
  OdometryReading reading_;
  std::string event_;
  DeviceStatus status_;
  PioneerDriver::Clock::time_point next_report_{};
  PioneerConnection reported_ = PioneerConnection::closed;
};

}  // namespace azimuth
