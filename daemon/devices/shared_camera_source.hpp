#pragma once
#include <filesystem>

#include "daemon/pipeline/source.hpp"
#include "drivers/camera/shared_camera.hpp"

namespace azimuth {

/// Bearings from a camera in another process (drivers/camera/shared_camera.hpp).
class SharedCameraSource final : public Source {
 public:
  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`.
  SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic);

  const char* name() const override { return "camera"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;

 private:
  void report(SourceWires& wires);

  std::string socket_;
  Duration epoch_minus_monotonic_;
  SharedCamera camera_;
  BearingSet set_;
  DeviceStatus status_;
  bool told_ = false, was_connected_ = false;
};

}  // namespace azimuth
