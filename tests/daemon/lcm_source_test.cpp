// The sources that receive messages from another process. The daemon's own sender takes the part of that process, on a
// loopback in a separate network namespace.

#include "daemon/devices/lcm_source.hpp"

#include <azimuth/image_t.hpp>
#include <functional>
#include <gmock/gmock.h>

#include "base/clocks.hpp"
#include "daemon/publish/lcm_sender.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Clock = LcmSource::Clock;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

Stamp wall() {
  return Stamp{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
}

class LcmSourceTest : public ::testing::Test {
 protected:
  bool turn_until(LcmSource& source, const std::function<bool()>& done) {
    SourceWires wires{odometry_, nullptr, &frames_, status_wire_, events_wire_};
    for (const auto limit = Clock::now() + 20s; Clock::now() < limit;) {
      if (done()) return true;
      source.turn(bell_, wires);
      status_wire_.take(status_);
      DeviceEvent event;
      while (events_wire_.pop(event)) events_.push_back(event);
    }
    return false;
  }
  bool text_has(const std::string& words) const { return status_.text.find(words) != std::string::npos; }

  void send_odometry(double x_m, Stamp stamp) {
    OdometryReading reading;
    reading.stamp = stamp;
    reading.sequence = sequence_++;
    reading.T_odom_body.x_m = x_m;
    sender_.send("ODOMETRY", to_message(reading));
  }
  void send_image(std::uint8_t filling) {
    const std::vector<std::byte> pixels(std::size_t{320} * 240, std::byte{filling});
    image_t message{};
    fill_message({packed_format(PixelFormat::gray8, 320, 240), pixels}, wall(), message);
    sender_.send("CAMERA", message);
  }

  Doorbell bell_, reader_;
  OdometryWire odometry_{reader_};
  FramesWire frames_{reader_};
  Newest<DeviceStatus> status_wire_{reader_};
  EveryOne<DeviceEvent, 16> events_wire_{reader_};
  DeviceStatus status_;
  std::vector<DeviceEvent> events_;
  LcmSender sender_{kUrl, ""};
  std::uint64_t sequence_ = 0;
  LcmSourceSettings settings_ = [] {
    LcmSourceSettings settings;
    settings.silent_s = 0.2;
    return settings;
  }();
};

TEST_F(LcmSourceTest, OdometryComesFromAnotherProcess) {
  LcmOdometerSource source(settings_, *parse_lcm_url(kUrl), epoch_minus_monotonic());
  ASSERT_TRUE(turn_until(source, [&] { return text_has("silent: nothing of use on ODOMETRY"); }));
  EXPECT_FALSE(status_.works);
  const Stamp sent = wall();
  send_odometry(3.5, sent);
  OdometryReading got;
  ASSERT_TRUE(turn_until(source, [&] { return odometry_.pop(got); }));
  EXPECT_EQ(got.T_odom_body.x_m, 3.5);
  EXPECT_LT(std::chrono::abs(got.stamp - sent), 100ms);
  ASSERT_TRUE(turn_until(source, [&] {
    send_odometry(3.5, wall());
    return status_.works;
  }));
  EXPECT_TRUE(text_has("running (ODOMETRY)"));
  ASSERT_TRUE(turn_until(source, [&] { return !status_.works; })) << "its sender has stopped";
  ASSERT_GE(events_.size(), 3U);
  EXPECT_TRUE(events_[0].trouble);
  EXPECT_FALSE(events_[1].trouble);
  EXPECT_THAT(events_[1].text, HasSubstr("odometer: running"));
}

TEST_F(LcmSourceTest, SaysWhyNothingIsOfUse) {
  LcmOdometerSource source(settings_, *parse_lcm_url(kUrl), epoch_minus_monotonic());
  ASSERT_TRUE(turn_until(source, [&] {
    send_odometry(0.0, wall() - 1h);
    sender_.send("ODOMETRY", image_t{});
    return text_has("malformed") && text_has("with stamps too old");
  }));
  EXPECT_FALSE(status_.works);
  OdometryReading got;
  EXPECT_FALSE(odometry_.pop(got));
}

TEST_F(LcmSourceTest, SaysThatTheSenderHasAnotherClock) {
  LcmOdometerSource source(settings_, *parse_lcm_url(kUrl), epoch_minus_monotonic());
  const auto is_said = [&](const auto& now, const std::string& words) {
    return turn_until(source, [&] {
      send_odometry(0.0, now());
      return text_has(words);
    });
  };
  ASSERT_TRUE(is_said([] { return wall() - 1h; },
                      "ODOMETRY is stamped by a clock 3600.0 s behind this machine's: synchronise them, "
                      "or set daemon.lcm_source.stamps = \"receipt\""));
  EXPECT_THAT(events_.back().text, HasSubstr("odometer: ODOMETRY is stamped by a clock")) << "in the log as well";
  ASSERT_TRUE(is_said([] { return stamp_from_us(to_us(wall()) / 1000); }, "is utime in microseconds?"));
  EXPECT_FALSE(status_.works);
}

TEST_F(LcmSourceTest, ImagesComeFromAnotherProcess) {
  LcmCameraSource source(settings_, *parse_lcm_url(kUrl), epoch_minus_monotonic());
  ASSERT_TRUE(turn_until(source, [&] { return text_has("silent: nothing of use on CAMERA"); }));
  for (std::uint8_t i = 1; i < 30; ++i) {  // more images than there are slots
    send_image(i);
    Frame frame;
    ASSERT_TRUE(turn_until(source, [&] { return frames_.take(frame); }));
    EXPECT_EQ(frame.bytes().back(), std::byte{i});
    EXPECT_EQ(frame.sequence, i);
  }
  EXPECT_TRUE(turn_until(source, [&] {
    send_image(99);
    return status_.works;
  }));
}

}  // namespace
}  // namespace azimuth
