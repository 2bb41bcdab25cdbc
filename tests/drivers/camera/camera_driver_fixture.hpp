#pragma once
// A camera driver and its simulated device, in virtual time.

#include <algorithm>
#include <cerrno>
#include <gmock/gmock.h>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/camera_driver.hpp"
#include "tests/drivers/camera/fake_stream.hpp"

namespace azimuth {

class CameraDriverTest : public testing::Test {
 protected:
  using Clock = CameraDriver::Clock;
  using Read = ImageStream::Read;

  void SetUp() override { start({}); }
  void start(const CameraDriverSettings& settings) {
    driver_ = std::make_unique<CameraDriver>(settings, device_.opener());
  }

  /// Lets the device send an image now.
  void send() { device_.images.push_back({Read::image, sequence_++, stamp()}); }
  void send(Read read) { device_.images.push_back({read, sequence_, stamp()}); }
  Stamp stamp() const { return stamp_from_us(std::chrono::duration_cast<Duration>(now_.time_since_epoch()).count()); }

  void turn() {
    driver_->turn(now_);
    Frame frame;
    while (driver_->take(frame)) frames_.push_back({Read::image, frame.sequence, frame.stamp});
    std::string event;
    while (driver_->take_event(event)) events_.push_back(event);
  }
  /// Calls the driver when it is due, at least every 10 ms. If `every` is not 0, the device sends an image in each such
  /// interval.
  void run(Clock::duration time, Clock::duration every = {}) {
    const auto until = now_ + time;
    auto next = now_;
    while (now_ < until) {
      if (every.count() > 0 && now_ >= next) {
        send();
        next += every;
      }
      turn();
      now_ += std::clamp<Clock::duration>(driver_->due_in(now_), std::chrono::milliseconds(1),
                                          std::chrono::milliseconds(10));
      if (every.count() > 0) now_ = std::min(now_, next);
    }
  }
  /// Runs until `done` or `limit` and returns the elapsed time.
  template <class Done>
  Clock::duration run_until(Clock::duration limit, const Done& done) {
    const auto begun = now_;
    while (!done() && now_ - begun < limit) run(std::chrono::milliseconds(1));
    return now_ - begun;
  }
  const CameraState& state() const { return driver_->state(); }
  bool is(Connection connection) const { return state().connection == connection; }
  void go_away() {
    device_.images.clear();
    device_.failure = {"/dev/omnicam: VIDIOC_DQBUF: No such device", ENODEV};
    send(Read::failed);
    device_.opening = {"/dev/omnicam: open: No such file or directory", ENOENT};
  }
  void come_back() {
    device_.opening = {};
    device_.images.clear();
    sequence_ = 0;
  }

  Clock::time_point now_{std::chrono::seconds(1000)};
  test::FakeCameraDevice device_;
  std::unique_ptr<CameraDriver> driver_;
  std::uint64_t sequence_ = 0;
  std::vector<test::FakeImage> frames_;
  std::vector<std::string> events_;
};

}  // namespace azimuth
