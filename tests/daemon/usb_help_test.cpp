// Hot-plug and port resets as the sources use them. libusb is replaced by tests/drivers/usb/fake_libusb.hpp.

#include "daemon/devices/usb_help.hpp"

#include <functional>
#include <gmock/gmock.h>
#include <latch>
#include <mutex>
#include <thread>

#include "daemon/devices/camera_source.hpp"
#include "daemon/devices/odometer_sources.hpp"
#include "tests/drivers/camera/fake_stream.hpp"
#include "tests/drivers/pioneer/scripted_robot.hpp"
#include "tests/drivers/usb/fake_libusb.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::test::FakeController;
using pioneer::test::PtyRobot;
using test::fake_usb;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A port resetter that resets nothing and records the requested ports.
class AskedPorts {
 public:
  explicit AskedPorts(PortResetResult result = {true, "reset"}) : result_(std::move(result)) {}

  std::shared_ptr<PortResetter> resetter() {
    return std::make_shared<PortResetter>([this](const UsbPort& port, PortReset::Clock::time_point) {
      const std::scoped_lock lock(mutex_);
      ports_.push_back(port.text());
      return result_;
    });
  }
  std::vector<std::string> ports() const {
    const std::scoped_lock lock(mutex_);
    return ports_;
  }

 private:
  PortResetResult result_;
  mutable std::mutex mutex_;
  std::vector<std::string> ports_;
};

bool soon(const std::function<bool()>& done) {
  for (const auto limit = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < limit;) {
    if (done()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

TEST(PortResetter, AnswersEachClientWithItsOwnResult) {
  PortResetter resetter([](const UsbPort& port, PortReset::Clock::time_point) {
    return PortResetResult{true, port.text()};
  });
  resetter.request(0, *UsbPort::parse("1-1"));
  resetter.request(1, *UsbPort::parse("2-2"));
  PortResetResult result;
  ASSERT_TRUE(soon([&] { return resetter.take(1, result); }));
  EXPECT_EQ(result.text, "2-2");
  ASSERT_TRUE(soon([&] { return resetter.take(0, result); }));
  EXPECT_EQ(result.text, "1-1");
  EXPECT_FALSE(resetter.take(0, result)) << "once";
}

TEST(PortResetter, NobodyWaitsForAResetAndNoneBeginsAtTheEnd) {
  std::latch may_end(1);
  std::atomic<int> begun = 0;
  std::optional<PortResetter> resetter(std::in_place, [&](const UsbPort&, PortReset::Clock::time_point) {
    ++begun;
    may_end.wait();
    return PortResetResult{};
  });
  resetter->request(0, *UsbPort::parse("1-1"));
  ASSERT_TRUE(soon([&] { return begun == 1; }));
  resetter->request(0, *UsbPort::parse("1-1"));
  PortResetResult result;
  EXPECT_FALSE(resetter->take(0, result));
  std::jthread destroys([&] { resetter.reset(); });
  std::this_thread::sleep_for(50ms);  // the destructor runs before the reset returns
  may_end.count_down();
  destroys.join();
  EXPECT_EQ(begun, 1);
}

class UsbHelpTest : public ::testing::Test {
 protected:
  UsbHelpTest() { test::reset_fake_usb(); }

  static std::vector<std::string> events(UsbHelp& help) {
    std::vector<std::string> texts;
    DeviceEvent event;
    while (help.take_event(event)) texts.push_back(event.text);
    return texts;
  }
  /// Requests a reset and waits for its end; false if the request is refused.
  bool reset(UsbHelp& help) const {
    if (!help.reset("1-2", now_)) return false;
    EXPECT_TRUE(soon([&] { return help.take_end(); }));
    return true;
  }
  /// The number of minutes until the next reset is permitted.
  int minutes_to_next(UsbHelp& help) {
    for (int minutes = 1; minutes < 1000; ++minutes) {
      now_ += 1min;
      if (reset(help)) return minutes;
    }
    return 1000;
  }

  UsbHelp::Clock::time_point now_{1h};
};

TEST_F(UsbHelpTest, WakesForWhatArrivesOnly) {
  UsbHelp help(std::make_unique<UsbMonitor>(), nullptr, 0, 1min);
  EXPECT_GE(help.polled().fd, 0);
  EXPECT_FALSE(help.turn());
  fake_usb().unplug({1, {2}});
  EXPECT_FALSE(help.turn());
  fake_usb().plug_in({1, {2}});
  EXPECT_TRUE(help.turn());
  EXPECT_FALSE(help.turn());
}

TEST_F(UsbHelpTest, SaysOnceThatNothingWillBeTold) {
  fake_usb().fail(test::UsbCall::init, LIBUSB_ERROR_ACCESS);
  UsbHelp help(std::make_unique<UsbMonitor>(), nullptr, 0, 1min);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(help.turn());
  EXPECT_EQ(help.polled().fd, -1);
  EXPECT_THAT(events(help), ElementsAre(HasSubstr("Access denied")));
}

TEST_F(UsbHelpTest, WithoutEitherItDoesNothing) {
  UsbHelp help;
  EXPECT_FALSE(help.turn());
  EXPECT_FALSE(help.may_reset(now_));
  EXPECT_FALSE(help.reset("1-2", now_));
  EXPECT_FALSE(help.take_end());
  EXPECT_EQ(help.polled().fd, -1);
}

TEST_F(UsbHelpTest, ResetsInVainBecomeRarerUntilTheDeviceWorks) {
  AskedPorts asked;
  UsbHelp help(nullptr, asked.resetter(), 0, 5min);
  EXPECT_TRUE(reset(help));
  EXPECT_EQ(minutes_to_next(help), 1);
  EXPECT_EQ(minutes_to_next(help), 2);
  EXPECT_EQ(minutes_to_next(help), 4);
  EXPECT_EQ(minutes_to_next(help), 5);
  EXPECT_EQ(minutes_to_next(help), 5);
  help.works();
  EXPECT_EQ(minutes_to_next(help), 5) << "as said at the last reset";
  EXPECT_EQ(minutes_to_next(help), 1);
  EXPECT_EQ(help.resets(), 8U);
}

TEST_F(UsbHelpTest, OnlyOneIsUnderWayAndOnlyPortsAreReset) {
  AskedPorts asked;
  UsbHelp help(nullptr, asked.resetter(), 1, 1min);
  EXPECT_FALSE(help.reset("", now_));
  EXPECT_FALSE(help.reset("usb1", now_));
  EXPECT_TRUE(help.reset("1-2", now_));
  EXPECT_FALSE(help.reset("1-2", now_ + 10min));
  EXPECT_TRUE(soon([&] { return help.take_end(); }));
  EXPECT_FALSE(help.take_end());
  EXPECT_TRUE(help.reset("1-2", now_ + 10min));
  EXPECT_TRUE(soon([&] { return help.take_end(); }));
  EXPECT_THAT(asked.ports(), ElementsAre("1-2", "1-2"));
}

TEST_F(UsbHelpTest, TheSameFailureIsToldOnceAndNotCounted) {
  AskedPorts asked({false, "cannot open"});
  UsbHelp help(nullptr, asked.resetter(), 0, 1min);
  for (int i = 0; i < 3; ++i, now_ += 1min) EXPECT_TRUE(reset(help));
  EXPECT_THAT(events(help), ElementsAre("cannot open"));
  EXPECT_EQ(help.resets(), 0U);
}

/// Runs the turns of a source and collects its status and events.
class SourceTest : public ::testing::Test {
 protected:
  bool turn_until(Source& source, const std::function<bool()>& done) {
    SourceWires wires{odometry_, nullptr, &frames_, status_wire_, events_wire_};
    for (const auto limit = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < limit;) {
      if (done()) return true;
      bell_.ring();  // the turn must not sleep
      source.turn(bell_, wires);
      status_wire_.take(status_);
      DeviceEvent event;
      while (events_wire_.pop(event)) events_.push_back(event.text);
    }
    return false;
  }

  Doorbell bell_, reader_;
  OdometryWire odometry_{reader_};
  FramesWire frames_{reader_};
  Newest<DeviceStatus> status_wire_{reader_};
  EveryOne<DeviceEvent, 16> events_wire_{reader_};
  DeviceStatus status_;
  std::vector<std::string> events_;
};

class PioneerSourceTest : public SourceTest {
 protected:
  static AdapterHelp help(AskedPorts& asked, const std::optional<UsbPort>& port) {
    return {UsbHelp(nullptr, asked.resetter(), 0, 1h), 50ms, [port](const std::string&) { return port; }};
  }
  static PioneerSettings settings(const PtyRobot& robot) {
    PioneerSettings settings;
    settings.device = robot.device();
    return settings;
  }

  FakeController controller_;
  PtyRobot robot_{controller_};
};

TEST_F(PioneerSourceTest, ASilentAdapterIsLetGoOfAndItsPortReset) {
  AskedPorts asked({true, "USB port 1-2: reset"});
  PioneerSource source(settings(robot_), Duration{}, help(asked, UsbPort::parse("1-2")));
  ASSERT_TRUE(turn_until(source, [&] { return status_.port_resets == 1; }));
  EXPECT_THAT(asked.ports(), ElementsAre("1-2"));
  EXPECT_THAT(events_, testing::Contains(HasSubstr("let go of")));
  EXPECT_THAT(events_, testing::Contains("odometer: USB port 1-2: reset"));
  // The robot answers now. The end of the reset wakes the source, so it connects within moments.
  ASSERT_TRUE(turn_until(source, [&] {
    robot_.serve();
    robot_.send(controller_.cycle());
    return status_.works;
  }));
  EXPECT_EQ(asked.ports().size(), 1U);
}

TEST_F(PioneerSourceTest, WhatIsNotPluggedInByUsbIsNeverReset) {
  AskedPorts asked;
  PioneerSource source(settings(robot_), Duration{}, help(asked, std::nullopt));
  const auto until = std::chrono::steady_clock::now() + 300ms;
  ASSERT_TRUE(turn_until(source, [&] { return std::chrono::steady_clock::now() > until; }));
  EXPECT_THAT(asked.ports(), IsEmpty());
}

class UsbCameraTest : public SourceTest {
 protected:
  /// The camera gives one image and then falls silent.
  bool fall_silent(CameraSource& source) {
    const auto now = std::chrono::duration_cast<Duration>(CameraSource::Clock::now().time_since_epoch());
    device_.images.push_back({ImageStream::Read::image, 0, Stamp{now}});
    return turn_until(source, [&] { return status_.works; }) && turn_until(source, [&] { return !status_.works; });
  }
  test::FakeCameraDevice device_;
};

TEST_F(UsbCameraTest, ASilentOneHasItsPortResetOnce) {
  AskedPorts asked({true, "USB port 1-2: reset"});
  CameraSource source({.silent_s = 0.05}, device_.opener(), Duration{}, {nullptr, asked.resetter(), 1, 1min});
  ASSERT_TRUE(fall_silent(source));
  ASSERT_TRUE(turn_until(source, [&] { return status_.port_resets == 1; }));
  EXPECT_THAT(events_, testing::Contains("camera: USB port 1-2: reset"));
  const auto until = std::chrono::steady_clock::now() + 200ms;
  ASSERT_TRUE(turn_until(source, [&] { return std::chrono::steady_clock::now() > until; }));
  EXPECT_THAT(asked.ports(), ElementsAre("1-2"));
}

TEST_F(UsbCameraTest, OneOfAnotherKindHasNone) {
  AskedPorts asked;
  device_.description.usb_port.clear();
  CameraSource source({.silent_s = 0.05}, device_.opener(), Duration{}, {nullptr, asked.resetter(), 1, 1min});
  ASSERT_TRUE(fall_silent(source));
  const auto until = std::chrono::steady_clock::now() + 200ms;
  ASSERT_TRUE(turn_until(source, [&] { return std::chrono::steady_clock::now() > until; }));
  EXPECT_THAT(asked.ports(), IsEmpty());
}

}  // namespace
}  // namespace azimuth
