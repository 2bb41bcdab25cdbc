// The driver on a scripted bus, in virtual time.

#include "drivers/can/can_driver.hpp"

#include <cerrno>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "tests/drivers/can/can_driver_bench.hpp"
#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::DriverBench;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(CanDriver, ReadsOdometryAndWhatTheRobotSaysOfItself) {
  DriverBench bench;
  CanFrame frame = test::empty_frame(test::kRobotId);
  frame.data = {0xC4, 0x09, 0xA5, 0x10, 0x01};  // 25.00 V, the three flags set
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

  frame.data = {0, 0, 0xA0, 0x0F, 0x02};
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
