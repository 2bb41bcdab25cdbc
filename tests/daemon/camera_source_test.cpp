#include "daemon/devices/camera_source.hpp"

#include <functional>
#include <gmock/gmock.h>

#include "daemon/publish/messages.hpp"
#include "tests/drivers/camera/fake_stream.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Read = ImageStream::Read;

constexpr Duration kCameraEpoch{1'000'000'000};

Stamp now_stamp() { return Stamp{std::chrono::duration_cast<Duration>(CameraSource::Clock::now().time_since_epoch())}; }

class CameraSourceTest : public testing::Test {
 protected:
  bool turn_until(const std::function<bool()>& done, bool wants_frames = true) {
    SourceWires wires{odometry_, nullptr, wants_frames ? &frames_ : nullptr, status_wire_, events_};
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < limit) {
      if (done()) return true;
      bell_.ring();  // the turn must not sleep
      source_.turn(bell_, wires);
      status_wire_.take(status_);
      DeviceEvent event;
      while (events_.pop(event)) told_.push_back(event);
    }
    return false;
  }
  bool text_has(const std::string& words) const { return status_.text.find(words) != std::string::npos; }
  void send() { device_.images.push_back({Read::image, sequence_++, now_stamp()}); }
  bool start() {
    send();
    return turn_until([&] { return status_.works; });
  }

  Doorbell bell_, reader_;
  OdometryWire odometry_{reader_};
  FramesWire frames_{reader_};
  Newest<DeviceStatus> status_wire_{reader_};
  EveryOne<DeviceEvent, 16> events_{reader_};
  test::FakeCameraDevice device_;
  CameraSource source_{{.silent_s = 0.05}, device_.opener(), kCameraEpoch};
  DeviceStatus status_;
  std::vector<DeviceEvent> told_;
  std::uint64_t sequence_ = 0;
};

TEST_F(CameraSourceTest, HandsFramesOnWithTheirStampsOnOurClock) {
  ASSERT_TRUE(turn_until([&] { return text_has("starting"); }));
  const Stamp stamp = now_stamp();
  device_.images.push_back({Read::image, 0, stamp});
  Frame frame;
  ASSERT_TRUE(turn_until([&] { return frames_.take(frame); }));
  EXPECT_EQ(frame.stamp, stamp + kCameraEpoch);
  ASSERT_TRUE(turn_until([&] { return status_.works; }));
  EXPECT_EQ(status_.text, "running (/dev/omnicam, gray8 4x3)");
  ASSERT_FALSE(told_.empty());
  EXPECT_FALSE(told_.back().trouble);
  EXPECT_EQ(told_.back().text, "camera: images come from /dev/omnicam (Omni), gray8 4x3");
}

TEST_F(CameraSourceTest, SaysWhenItFallsSilentAndComesBack) {
  ASSERT_TRUE(start());
  ASSERT_TRUE(turn_until([&] { return text_has("silent: /dev/omnicam: no image"); }));
  EXPECT_FALSE(status_.works);
  EXPECT_TRUE(told_.back().trouble);
  EXPECT_TRUE(turn_until([&] {
    if (device_.images.empty()) send();
    return status_.works;
  }));
  EXPECT_EQ(status_.reconnects, 1U);
}

TEST_F(CameraSourceTest, SaysWhyItCannotBeOpened) {
  {
    const std::lock_guard lock(device_.mutex);
    device_.opening = {"/dev/omnicam: open: Permission denied", 13};
  }
  EXPECT_TRUE(turn_until([&] { return text_has("away: /dev/omnicam: open: Permission denied"); }));
}

TEST_F(CameraSourceTest, CountsWhatWasLost) {
  ASSERT_TRUE(start());
  EXPECT_TRUE(turn_until([&] {
    if (device_.images.empty() && sequence_ == 1) {
      sequence_ += 3;
      device_.images.push_back({Read::corrupt, 0, {}});
    }
    if (device_.images.empty()) send();
    return text_has("2 missing, 1 corrupt");
  }));
  Status status;
  status.camera = status_;
  EXPECT_EQ(status_message(status).camera_missing, 2);
  EXPECT_EQ(status_message(status).camera_corrupt, 1);
}

TEST_F(CameraSourceTest, FramesNobodyWantsAreLeftAside) {
  Frame frame;
  EXPECT_TRUE(turn_until(
      [&] {
        if (device_.images.empty()) send();
        return sequence_ > 20;
      },
      false));
  EXPECT_FALSE(frames_.take(frame));
}

}  // namespace
}  // namespace azimuth
