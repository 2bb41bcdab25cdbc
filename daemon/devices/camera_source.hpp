#pragma once
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/devices/polled_source.hpp"
#include "daemon/devices/usb_help.hpp"
#include "drivers/camera/camera_driver.hpp"
#include "drivers/camera/image_stream.hpp"
#include "drivers/camera/shared_camera.hpp"

namespace azimuth {

/// Opens and closes a camera's streams on a thread of its own. A hanging device can block either call for seconds, and
/// the source's thread must send heartbeats for the watchdog.
///
/// The streams are wrapped: destroying one hands the real stream to that thread. The thread closes all such streams
/// before it opens another, so a camera is never open twice.
///
/// Thread contract: open() and the streams belong to one thread. The destructor waits for the device.
class BackgroundOpener {
 public:
  explicit BackgroundOpener(StreamOpener open);
  BackgroundOpener(const BackgroundOpener&) = delete;
  BackgroundOpener& operator=(const BackgroundOpener&) = delete;
  ~BackgroundOpener();

  /// The function for CameraDriver: starts to open the camera, and returns the result once it is known. Does not block.
  OpenedStream open();

  /// The data shared by the two threads. It lives as long as any stream.
  struct Desk {
    std::mutex mutex;
    std::condition_variable work;
    /// An opening has been requested and its result has not been fetched yet.
    bool opening = false;
    bool begun = false;  ///< the thread has started the opening, or finished it
    bool quit = false;
    std::optional<OpenedStream> opened;
    std::vector<std::unique_ptr<ImageStream>> to_close;
  };

 private:
  void run();

  StreamOpener open_;
  std::shared_ptr<Desk> desk_ = std::make_shared<Desk>();
  std::jthread thread_;  // declared last because it uses the other members
};

/// Images of a camera that the daemon opens itself.
class CameraSource final : public PolledSource {
 public:
  /// The stamps are CLOCK_MONOTONIC plus `to_stamp`: the offset to the epoch minus the delay of the device's stamps.
  /// When a USB camera is present but silent, its port is reset, provided that `usb` can do this.
  CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb = {});

  const char* name() const override { return "camera"; }
  void restore(const OdometerMemory& /*memory*/) override {}  // a camera has no odometry

 private:
  void work(Clock::time_point now, SourceWires& wires) override;
  std::optional<DeviceCondition> condition() const override { return DeviceCondition{driver_.state().connection}; }
  void describe(DeviceStatus& status) const override;
  Polled polled() const override;
  Clock::duration due_in(Clock::time_point now) const override { return driver_.due_in(now); }
  void tell(EventRelay& relay, bool trouble, SourceWires& wires) override;

  void help(Clock::time_point now);
  void pass_on(SourceWires& wires);

  Duration to_stamp_;
  BackgroundOpener opener_;  // outlives the driver's stream
  CameraDriver driver_;
  UsbHelp usb_;
  Frame frame_;
};

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
