// A base on a CAN bus, from the source to the pipeline's wires.

#include <azimuth/status_t.hpp>
#include <cerrno>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "daemon/devices/odometer_sources.hpp"
#include "tests/drivers/can/fake_base.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// The frames waiting on a bus, and whether the bus is gone.
struct WaitingFrames {
  std::vector<CanFrame> frames;
  bool is_gone = false;
};

class WaitingLink final : public CanLink {
 public:
  explicit WaitingLink(WaitingFrames& waiting) : waiting_(waiting) {}
  int descriptor() const override { return -1; }
  Received receive(std::span<CanReception> into) override {
    if (waiting_.is_gone) return {0, false, CanTrouble{"can0", "read", ENODEV}};
    Received received;
    for (const CanFrame& frame : waiting_.frames) into[received.count++] = {frame, DeviceClock::now()};
    waiting_.frames.clear();
    return received;
  }
  bool is_present() const override { return !waiting_.is_gone; }
  Counts counts() const override { return {}; }
  std::string note() const override { return ""; }

 private:
  WaitingFrames& waiting_;
};

class CanSourceTest : public testing::Test {
 protected:
  CanSourceTest() {
    layout.battery = CanSignal{test::kRobotId, {0, 8}, CanNumber::unsigned_integer, 0.1};
    layout.emergency_stop = CanSignal{test::kRobotId, {8, 1}};
    layout.bumper = CanSignal{test::kRobotId, {9, 1}};
    layout.charging = CanSignal{test::kRobotId, {10, 1}};
    source.emplace(CanSettings{}, layout, Duration{0}, [this](const std::string& name, std::span<const CanId>) {
      return waiting.is_gone ? OpenedCanLink(tl::unexpected(CanTrouble{name, "no such interface", 0}))
                             : OpenedCanLink(std::make_unique<WaitingLink>(waiting));
    });
  }

  void turn() {
    bell.ring();  // the turn must not sleep
    source->turn(bell, wires);
    status_wire.take(status);
  }
  void drive(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      base.drive(0.5, 0.5, 0.004);
      for (const CanFrame& frame : base.frames(layout)) waiting.frames.push_back(frame);
      turn();
      std::this_thread::sleep_for(4ms);
    }
  }

  CanLayout layout = test::ticks_layout(test::kLeftId);
  WaitingFrames waiting;
  test::FakeBase base;
  Doorbell bell, reader_bell;
  OdometryWire odometry{reader_bell};
  Newest<DeviceStatus> status_wire{reader_bell};
  EveryOne<DeviceEvent, 16> events{reader_bell};
  SourceWires wires{odometry, nullptr, nullptr, status_wire, events};
  std::optional<CanSource> source;
  DeviceStatus status;
};

TEST_F(CanSourceTest, SendsOdometryAndWhatTheRobotSaysOfItself) {
  CanFrame robot = test::empty_frame(test::kRobotId);
  robot.data = {241, 0b101};
  waiting.frames.push_back(robot);
  drive(5);
  EXPECT_TRUE(status.works);
  EXPECT_EQ(status.text, "running");
  EXPECT_DOUBLE_EQ(status.battery_v, 24.1);
  EXPECT_EQ(status.robot_flags, static_cast<std::uint32_t>(status_t::ROBOT_EMERGENCY_STOP) +
                                    static_cast<std::uint32_t>(status_t::ROBOT_CHARGING));
  OdometryReading reading;
  std::size_t readings = 0;
  while (odometry.pop(reading)) EXPECT_EQ(reading.sequence, readings++);
  EXPECT_EQ(readings, 5U);
  EXPECT_GT(reading.T_odom_body.x_m, 0.007);
}

TEST_F(CanSourceTest, TellsOfAnInterfaceThatIsGoneAndComesBack) {
  drive(3);
  waiting.is_gone = true;
  turn();
  EXPECT_FALSE(status.works);
  EXPECT_THAT(status.text,
              // only the start: a slow machine adds missed values to the text
              testing::StartsWith("away: can0: read: No such device"));
  waiting.is_gone = false;
  waiting.frames.clear();
  std::this_thread::sleep_for(30ms);
  drive(3);
  EXPECT_TRUE(status.works);
  EXPECT_EQ(status.reconnects, 1U);
  DeviceEvent event;
  std::vector<std::string> told;
  while (events.pop(event)) told.push_back(event.text);
  EXPECT_THAT(
      told, testing::ElementsAre("odometry comes from can0", "can0: read: No such device", "odometry comes from can0"));
}

}  // namespace
}  // namespace azimuth
