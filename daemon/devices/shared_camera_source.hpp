#pragma once
#include <filesystem>
#include <string>

#include "daemon/devices/polled_source.hpp"
#include "drivers/camera/shared_camera.hpp"

namespace azimuth {

/// Images or bearings, depending on which are wanted, from a camera in another process
/// (drivers/camera/shared_camera.hpp).
class SharedCameraSource final : public PolledSource {
 public:
  /// The stamps are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. A connected camera that sends nothing for
  /// `silent_after` is reported as silent.
  SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic, Clock::duration silent_after);

  const char* name() const override { return "camera"; }
  void restore(const OdometerMemory& /*memory*/) override {}  // a camera has no odometry

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return condition_; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override { return only(camera_.descriptor(), POLLIN); }
  Clock::duration due_in(Clock::time_point now) const override { return camera_.next_turn() - now; }
  bool status_is_news() const override { return true; }

  bool pass_on(SourceWires& wires);
  std::optional<DeviceCondition> judge(bool wants_frames, Clock::time_point now) const;

  std::string socket_;
  Duration epoch_minus_monotonic_;
  SharedCamera camera_;
  BearingSet set_;
  Frame frame_;
  Clock::duration silent_after_;
  Clock::time_point last_sample_{};  // time of the last sample, or of the connection if no sample came since
  bool was_connected_ = false;
  std::optional<DeviceCondition> condition_;
};

}  // namespace azimuth
