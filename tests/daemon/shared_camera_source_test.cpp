// The source of a shared camera, connected to a real camera server.

#include <functional>
#include <gmock/gmock.h>

#include "daemon/devices/camera_source.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr Duration kEpoch{1'000'000'000};

class SharedCameraSourceTest : public test::CameraLink {
 protected:
  enum class Wanted { bearings, frames };

  /// Runs the turns of source and server until `done`; returns false on a timeout.
  bool turn_until(Wanted wanted, CameraServer* server, const std::function<bool()>& done) {
    SourceWires wires{odometry_, wanted == Wanted::bearings ? &bearings_ : nullptr,
                      wanted == Wanted::frames ? &frames_ : nullptr, status_wire_, events_};
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < limit) {
      if (done()) return true;
      bell_.ring();  // the turn must not sleep
      source_.turn(bell_, wires);
      if (server) server->turn();
      status_wire_.take(status_);
    }
    return false;
  }
  bool text_has(const std::string& words) const { return status_.text.find(words) != std::string::npos; }

  Doorbell bell_, reader_;
  OdometryWire odometry_{reader_};
  BearingsWire bearings_{reader_};
  FramesWire frames_{reader_};
  Newest<DeviceStatus> status_wire_{reader_};
  EveryOne<DeviceEvent, 16> events_{reader_};
  SharedCameraSource source_{path(), kEpoch, 50ms};
  DeviceStatus status_;
};

TEST_F(SharedCameraSourceTest, HandsFramesOnWithTheirStampsOnOurClock) {
  CameraServer server = test::serve(path());
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return server.has_client() && status_.works; }));
  EXPECT_THAT(status_.text, HasSubstr("gray8 64x48"));
  ASSERT_TRUE(test::send_filled(server, 7, stamp_from_us(5000)));
  Frame frame;
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return frames_.take(frame); }));
  EXPECT_EQ(frame.stamp, stamp_from_us(5000) + kEpoch);
  EXPECT_EQ(frame.bytes().front(), std::byte{7});
}

TEST_F(SharedCameraSourceTest, ReplacedAndUnwantedFramesGoBackAtOnce) {
  CameraServer server = test::serve(path());
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return server.has_client() && status_.works; }));
  const unsigned many = 20;  // more than the 4 buffers
  for (const Wanted wanted : {Wanted::frames, Wanted::bearings}) {
    unsigned sent = 0;
    EXPECT_TRUE(turn_until(wanted, &server, [&] {
      sent += test::send_filled(server, 1) ? 1 : 0;
      return sent == many;
    }));
  }
}

TEST_F(SharedCameraSourceTest, ReadyMadeBearingsAreLeftAsideWhenFramesAreWanted) {
  CameraServer server = test::serve(path());
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return server.has_client() && status_.works; }));
  ASSERT_TRUE(server.send(test::set_of(1, 3)));
  ASSERT_TRUE(test::send_filled(server, 7));
  Frame frame;
  BearingSet set;
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return frames_.take(frame); }));
  EXPECT_FALSE(bearings_.pop(set));
  ASSERT_TRUE(server.send(test::set_of(2, 3)));
  ASSERT_TRUE(turn_until(Wanted::bearings, &server, [&] { return bearings_.pop(set); }));
  EXPECT_EQ(set.sequence, 2U);
}

TEST_F(SharedCameraSourceTest, SaysWhenACameraFallsSilentAndSpeaksAgain) {
  CameraServer server = test::serve(path());
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return text_has("running"); }));
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return text_has("has sent nothing for 0.05 s"); }));
  EXPECT_FALSE(status_.works);
  EXPECT_TRUE(turn_until(Wanted::frames, &server, [&] {
    test::send_filled(server, 7);
    return text_has("running");
  }));
  EXPECT_TRUE(status_.works);
  EXPECT_EQ(status_.reconnects, 0U);
}

TEST_F(SharedCameraSourceTest, AHealthyStartIsNoTrouble) {
  CameraServer server = test::serve(path());
  const auto greeted_late = std::chrono::steady_clock::now() + 10ms;
  ASSERT_TRUE(turn_until(Wanted::frames, nullptr, [&] { return std::chrono::steady_clock::now() > greeted_late; }));
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return status_.works; }));
  DeviceEvent event;
  ASSERT_TRUE(events_.pop(event));
  EXPECT_FALSE(event.trouble) << event.text;
  EXPECT_FALSE(events_.pop(event)) << event.text;
}

TEST_F(SharedCameraSourceTest, SaysWhatWasLost) {
  CameraServer server = test::serve(path());
  ASSERT_TRUE(turn_until(Wanted::bearings, &server, [&] { return server.has_client() && status_.works; }));
  EXPECT_FALSE(text_has("missing"));
  ASSERT_TRUE(server.send(test::set_of(1, 3)));
  ASSERT_TRUE(server.send(test::set_of(5, 3)));
  EXPECT_TRUE(turn_until(Wanted::bearings, &server, [&] { return text_has(", 3 missing"); })) << status_.text;
}

TEST_F(SharedCameraSourceTest, SaysWhenACameraServesAnotherProgram) {
  CameraServer server = test::serve(path());
  SharedCamera other(path());
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] {
    other.turn(std::chrono::steady_clock::now());
    return other.state().connected;
  }));
  ASSERT_TRUE(turn_until(Wanted::frames, &server, [&] { return text_has("waits for its turn: it serves another"); }));
  DeviceEvent event;
  ASSERT_TRUE(events_.pop(event));
  EXPECT_TRUE(event.trouble);
}

TEST_F(SharedCameraSourceTest, SaysWhenACameraHasNoImagesOrIsNotThere) {
  EXPECT_TRUE(turn_until(Wanted::frames, nullptr, [&] { return text_has("cannot be connected to"); }));
  FileResult<CameraServer> server = CameraServer::listen_for_bearings(path());
  ASSERT_TRUE(server);
  EXPECT_TRUE(turn_until(Wanted::frames, &*server, [&] { return text_has("sends no images"); }));
  EXPECT_FALSE(status_.works);
  DeviceEvent event;
  EXPECT_TRUE(events_.pop(event)) << "each change is told once";
  EXPECT_TRUE(event.trouble);
}

}  // namespace
}  // namespace azimuth
