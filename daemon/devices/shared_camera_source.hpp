#pragma once
#include <filesystem>
#include <string>

#include "daemon/pipeline/source.hpp"
#include "drivers/camera/shared_camera.hpp"

namespace azimuth {

/// Images or bearings, whichever are wanted, from a camera in another process (drivers/camera/shared_camera.hpp).
class SharedCameraSource final : public Source {
 public:
  using Clock = SharedCamera::Clock;

  /// Stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. A camera that is connected and says nothing for
  /// `silent_after` is in trouble.
  SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic, Clock::duration silent_after);

  const char* name() const override { return "camera"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;

 private:
  enum class Condition { unknown, unconnected, without_images, silent, running };

  bool pass_on(SourceWires& wires);
  Condition condition(const SourceWires& wires, Clock::time_point now) const;
  std::string description() const;
  void report(SourceWires& wires, Clock::time_point now);

  std::string socket_;
  Duration epoch_minus_monotonic_;
  SharedCamera camera_;
  BearingSet set_;
  Frame frame_;
  Clock::duration silent_after_;
  Clock::time_point last_sample_{};  // or the start of the connection
  bool was_connected_ = false;
  Condition condition_ = Condition::unknown;  // as last told
};

}  // namespace azimuth
