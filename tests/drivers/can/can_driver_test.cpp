// The driver on a scripted bus, in virtual time.

#include "drivers/can/can_driver.hpp"

#include <cerrno>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::FakeBase;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What the interface is like, and what waits in its socket.
struct FakeBus {
  bool is_there = true, is_up = true;
  int generation = 0;  // another after each replug
  int opened = 0;
  std::deque<CanReception> waiting;
  CanLink::Counts counts;
  std::vector<CanId> asked_for;
};

class FakeCanLink final : public CanLink {
 public:
  explicit FakeCanLink(FakeBus& bus) : bus_(bus), generation_(bus.generation) {}
  int descriptor() const override { return 99; }
  Received receive(std::span<CanReception> into) override {
    if (!is_present()) return {0, false, CanTrouble{"can0", "read", ENODEV}};
    if (!bus_.is_up && !std::exchange(told_down_, true)) return {0, true, {}};
    if (bus_.is_up) told_down_ = false;
    Received received;
    for (; received.count < into.size() && !bus_.waiting.empty(); bus_.waiting.pop_front())
      into[received.count++] = bus_.waiting.front();
    return received;
  }
  bool is_present() const override { return bus_.is_there && bus_.generation == generation_; }
  Counts counts() const override { return bus_.counts; }
  std::string note() const override { return "little buffer"; }

 private:
  FakeBus& bus_;
  int generation_;
  bool told_down_ = false;
};

CanLayout robot_layout() {
  CanLayout layout = test::ticks_layout();
  layout.battery = CanSignal{test::kRobotId, {0, 16}, CanNumber::unsigned_integer, 0.01};
  layout.emergency_stop = CanFlagSignal{{test::kRobotId, {16, 8}}, 0x0F, 0x05};
  layout.bumper = CanFlagSignal{{test::kRobotId, {24, 8}}, 0xF0, {}};
  layout.charging = CanFlagSignal{{test::kRobotId, {32, 1}}};
  return layout;
}

class DriverBench {
 public:
  FakeBus bus;
  CanLayout layout = robot_layout();
  CanDriver driver{CanSettings{}, layout, 1'000'000s,
                   [this](const std::string& name, std::span<const CanId> ids) { return open(name, ids); }};
  FakeBase base;
  DeviceClock::time_point now{1h};
  std::vector<OdometryReading> readings;
  std::vector<std::string> events;

  void run(DeviceClock::duration time, bool base_sends = true) {
    for (const auto end = now + time; now < end;) {
      now += 10ms;
      base.drive(0.5, 0.5, 0.01);
      if (base_sends && bus.is_there && bus.is_up)
        for (const CanFrame& frame : base.frames(layout)) bus.waiting.push_back({frame, now});
      turn();
    }
  }
  void turn() {
    EXPECT_GE(driver.due_in(now), 0ms);
    driver.turn(now);
    OdometryReading reading;
    while (driver.take(reading)) readings.push_back(reading);
    std::string event;
    while (driver.take_event(event)) events.push_back(event);
  }
  void error(std::uint32_t classes, std::uint8_t controller = 0) {
    CanFrame frame = test::empty_frame({classes, false});
    frame.kind = CanFrame::Kind::error;
    frame.data[1] = controller;
    bus.waiting.push_back({frame, now});
  }

 private:
  OpenedCanLink open(const std::string& name, std::span<const CanId> ids) {
    if (!bus.is_there) return tl::unexpected(CanTrouble{name, "no such interface", 0});
    ++bus.opened;
    bus.asked_for.assign(ids.begin(), ids.end());
    return std::make_unique<FakeCanLink>(bus);
  }
};

TEST(CanDriver, ReadsOdometryAndWhatTheRobotSaysOfItself) {
  DriverBench bench;
  CanFrame frame = test::empty_frame(test::kRobotId);
  frame.data = {0xC4, 0x09, 0xA5, 0x10, 0x01};  // 25.00 V, masked 5, masked 0x10, 1
  bench.bus.waiting.push_back({frame, bench.now});
  bench.run(1s);
  const CanState& state = bench.driver.state();
  EXPECT_EQ(state.connection, Connection::running);
  EXPECT_STREQ(text(state.connection), "running");
  EXPECT_NEAR(bench.readings.back().T_odom_body.x_m, 0.49, 0.011);
  EXPECT_DOUBLE_EQ(state.battery_V, 25.0);
  EXPECT_TRUE(state.emergency_stop);
  EXPECT_TRUE(state.bumper);
  EXPECT_TRUE(state.charging);
  EXPECT_EQ(state.reconnects(), 0U);
  EXPECT_NEAR(state.speed_m_s, 0.5, 0.02);
  EXPECT_THAT(bench.bus.asked_for, ElementsAre(test::kLeftId, test::kRightId, test::kRobotId));
  EXPECT_THAT(bench.events, ElementsAre("can0: little buffer", "odometry comes from can0"));

  frame.data = {0, 0, 0xA4, 0x0F, 0x02};
  bench.bus.waiting.push_back({frame, bench.now});
  bench.run(10ms);
  EXPECT_FALSE(state.emergency_stop);
  EXPECT_FALSE(state.bumper);
  EXPECT_FALSE(state.charging);
}

TEST(CanDriver, WhatTheBaseDoesNotSayIsUnknown) {
  DriverBench bench;
  bench.run(100ms);
  EXPECT_TRUE(std::isnan(bench.driver.state().battery_V));
  EXPECT_FALSE(bench.driver.state().emergency_stop);
}

TEST(CanDriver, ShortStatusFramesAreCountedAndChangeNothing) {
  DriverBench bench;
  CanFrame frame = test::empty_frame(test::kRobotId);
  frame.size = 1;
  bench.bus.waiting.push_back({frame, bench.now});
  bench.run(100ms);
  EXPECT_EQ(bench.driver.state().malformed, 4U);
  EXPECT_TRUE(std::isnan(bench.driver.state().battery_V));
}

TEST(CanDriver, AnInterfaceThatIsNotThereIsLookedForAndToldOnce) {
  DriverBench bench;
  bench.bus.is_there = false;
  bench.run(5s);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  EXPECT_THAT(bench.events, ElementsAre("can0: no such interface"));
  bench.bus.is_there = true;
  bench.run(250ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.descriptor(), 99);
}

TEST(CanDriver, AnAdapterThatIsPluggedInAgainGoesOnFromItsCounters) {
  DriverBench bench;
  bench.run(1s);
  for (int i = 1; i <= 20; ++i) {
    bench.bus.is_there = false;
    bench.run(1s);
    EXPECT_EQ(bench.driver.state().connection, Connection::away);
    ++bench.bus.generation;
    bench.bus.is_there = true;
    bench.run(300ms);
    EXPECT_EQ(bench.driver.state().connection, Connection::running) << i;
    EXPECT_EQ(bench.driver.state().reconnects(), static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(bench.driver.state().restarts, 0U);
  EXPECT_NEAR(bench.readings.back().T_odom_body.x_m, bench.base.pose().x_m, 0.012);
}

TEST(CanDriver, AnInterfaceThatIsReplacedUnseenIsNoticed) {
  DriverBench bench;
  bench.run(1s, false);
  EXPECT_EQ(bench.driver.state().connection, Connection::starting);
  EXPECT_EQ(bench.bus.opened, 1);
  ++bench.bus.generation;
  bench.run(500ms);
  EXPECT_EQ(bench.bus.opened, 2);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
}

TEST(CanDriver, AnInterfaceThatIsSwitchedOffIsKept) {
  DriverBench bench;
  bench.run(1s);
  bench.bus.is_up = false;
  bench.run(100ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_EQ(bench.driver.state().trouble, "can0: is down");
  bench.run(2s);
  bench.bus.is_up = true;
  bench.run(30ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.bus.opened, 1);
  EXPECT_EQ(bench.driver.state().reconnects(), 1U);
}

TEST(CanDriver, ASilentBaseIsStaleAndNotAReconnect) {
  DriverBench bench;
  bench.run(1s);
  bench.run(1s, false);
  EXPECT_EQ(bench.driver.state().connection, Connection::silent);
  EXPECT_EQ(bench.driver.state().stale, 1U);
  EXPECT_THAT(bench.events, Contains("can0: no odometry"));
  bench.run(100ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.state().reconnects(), 0U);
}

TEST(CanDriver, BusOffIsToldAndEndsWhenFramesComeAgain) {
  DriverBench bench;
  bench.run(1s);
  bench.error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::passive);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  bench.error(CAN_ERR_BUSOFF);
  bench.run(100ms, false);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::off);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_THAT(bench.driver.state().trouble, HasSubstr("restart-ms"));
  bench.error(CAN_ERR_RESTARTED);
  bench.run(2s);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::active);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.state().bus_offs, 1U);
  EXPECT_EQ(bench.driver.state().error_frames, 3U);
  EXPECT_EQ(bench.driver.state().reconnects(), 1U);
  EXPECT_THAT(bench.events, Contains("can0: error-passive"));
}

TEST(CanDriver, BusOffIsToldAlsoWhenFramesComeAgainInTheSameTurn) {
  DriverBench bench;
  bench.run(1s);
  bench.events.clear();
  bench.error(CAN_ERR_BUSOFF);
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_THAT(bench.events, ElementsAre(HasSubstr("can0: bus-off"), "odometry comes from can0"));
}

TEST(CanDriver, ManyErrorFramesFillNoLog) {
  DriverBench bench;
  bench.run(1s);
  bench.events.clear();
  for (int i = 0; i < 1000; ++i) {
    bench.error(CAN_ERR_CRTL, i % 2 == 0 ? CAN_ERR_CRTL_RX_PASSIVE : CAN_ERR_CRTL_ACTIVE);
    bench.run(10ms);
  }
  EXPECT_LE(bench.events.size(), 12U);
  EXPECT_GE(bench.events.size(), 1U);
  EXPECT_EQ(bench.driver.state().error_frames, 1000U);
}

TEST(CanDriver, ControllerOverrunsAndKernelDropsAreOneNumber) {
  DriverBench bench;
  bench.run(100ms);
  bench.error(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW);
  bench.bus.counts = {.malformed = 2, .dropped = 5, .stamps_replaced = 1};
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().dropped, 6U);
  EXPECT_EQ(bench.driver.state().malformed, 2U);
  EXPECT_EQ(bench.driver.state().stamps_replaced, 1U);
  ++bench.bus.generation;
  bench.run(10ms);
  EXPECT_GE(bench.driver.state().dropped, 6U) << "of the link that is gone as well";
}

TEST(CanDriver, AFloodOfForeignFramesIsReadBitByBitAndLosesNothing) {
  DriverBench bench;
  bench.run(100ms);
  for (int i = 0; i < 50'000; ++i)
    bench.bus.waiting.push_back({test::empty_frame({0x400U + static_cast<std::uint32_t>(i % 256), false}), bench.now});
  for (const CanFrame& frame : bench.base.frames(bench.layout)) bench.bus.waiting.push_back({frame, bench.now});
  int turns = 0;
  for (; !bench.bus.waiting.empty(); ++turns) {
    const std::size_t before = bench.bus.waiting.size();
    bench.turn();
    ASSERT_LE(before - bench.bus.waiting.size(), 256U) << "work of a turn is bounded";
  }
  EXPECT_GE(turns, 50'000 / 256);
  EXPECT_EQ(bench.driver.state().foreign, 50'000U);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  bench.run(100ms);
  EXPECT_NEAR(bench.readings.back().T_odom_body.x_m, bench.base.pose().x_m, 0.012);
}

TEST(CanDriver, AfterAFullTurnTheNextIsDueAtOnce) {
  DriverBench bench;
  bench.run(100ms);
  for (int i = 0; i < 300; ++i) bench.bus.waiting.push_back({test::empty_frame({0x400, false}), bench.now});
  bench.turn();
  EXPECT_EQ(bench.driver.due_in(bench.now), 0ms);
  bench.turn();
  EXPECT_GT(bench.driver.due_in(bench.now), 0ms);
}

TEST(CanDriver, ReadingsNobodyTakesAreCounted) {
  DriverBench bench;
  for (int i = 0; i < 400; ++i) {
    bench.now += 10ms;
    bench.base.drive(0.5, 0.5, 0.01);
    for (const CanFrame& frame : bench.base.frames(bench.layout)) bench.bus.waiting.push_back({frame, bench.now});
    bench.driver.turn(bench.now);
  }
  OdometryReading reading;
  std::uint64_t taken = 0;
  while (bench.driver.take(reading)) ++taken;
  EXPECT_EQ(taken, 256U);
  EXPECT_EQ(reading.sequence + 1, taken + bench.driver.state().refused_readings);
}

TEST(CanDriver, IsClosedForGood) {
  DriverBench bench;
  bench.run(100ms);
  bench.driver.close();
  bench.readings.clear();
  bench.run(1s);
  EXPECT_EQ(bench.driver.state().connection, Connection::closed);
  EXPECT_THAT(bench.readings, IsEmpty());
  EXPECT_EQ(bench.driver.descriptor(), -1);
}

TEST(CanDriver, NothingAllocatesWhileOdometryComes) {
  DriverBench bench;
  bench.run(1s);
  std::vector<std::vector<CanFrame>> frames;
  for (int i = 0; i < 100; ++i) {
    bench.base.drive(0.5, 0.5, 0.01);
    frames.push_back(bench.base.frames(bench.layout));
  }
  std::size_t during = 0;
  OdometryReading reading;
  for (const auto& pair : frames) {
    bench.now += 10ms;
    for (const CanFrame& frame : pair) bench.bus.waiting.push_back({frame, bench.now});
    const std::size_t before = allocations();
    bench.driver.turn(bench.now);
    while (bench.driver.take(reading)) {
    }
    during += allocations() - before;
  }
  EXPECT_EQ(during, 0U);
}

}  // namespace
}  // namespace azimuth
