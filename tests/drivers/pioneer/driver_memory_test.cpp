// The driver of one process and that of the next with the same robot, in virtual time.

#include <gmock/gmock.h>

#include "tests/drivers/pioneer/driver_bench.hpp"
#include "tests/drivers/pioneer/scripted_robot.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::test::FakeController;
using pioneer::test::PtyRobot;
using pioneer::test::readable;
using Bench = pioneer::test::DriverBench;

/// A robot that has driven 0.6 m east and 0.2 m north, with counters that wrap on the way, and its driver's memory.
class PioneerMemory : public testing::Test {
 protected:
  PioneerMemory() {
    first_.run(1s, robot_, controller_);
    controller_.sip.x_units = 32500;
    first_.run(100ms, robot_, controller_);
    for (int i = 0; i < 10; ++i) drive(60, 20);
    first_.run(200ms, robot_, controller_);
    remembers_ = first_.driver.remember(memory_);
  }

  void drive(int x_units, int y_units) {
    controller_.sip.x_units = static_cast<std::uint16_t>((controller_.sip.x_units + x_units) & 0x7FFF);
    controller_.sip.y_units = static_cast<std::uint16_t>((controller_.sip.y_units + y_units) & 0x7FFF);
    first_.run(100ms, robot_, controller_);
  }

  /// The readings of the next process, which starts `away` later.
  std::vector<OdometryReading> next_process(PioneerDriver::Clock::duration away) {
    Bench next(robot_.device(), true);
    next.now = first_.now + away;
    next.driver.restore(memory_);
    next.run(1500ms, robot_, controller_);
    EXPECT_EQ(next.driver.state().connection, Connection::running) << readable(next.events);
    EXPECT_FALSE(next.readings.empty());
    return next.readings;
  }

  FakeController controller_;
  PtyRobot robot_{controller_};
  Bench first_{robot_.device(), true};
  OdometerMemory memory_;
  bool remembers_ = false;
};

TEST_F(PioneerMemory, IsOfTheNewestPacket) {
  ASSERT_TRUE(remembers_);
  EXPECT_EQ(memory_.origin, first_.readings.back().origin);
  EXPECT_LT((memory_.T_odom_body.position() - first_.readings.back().T_odom_body.position()).norm(), 1e-9);
  EXPECT_LT(memory_.at - first_.readings.back().stamp, 5ms);
}

TEST_F(PioneerMemory, LetsTheNextProcessGoOnAndLosesNoMotion) {
  const Pose2 before = memory_.T_odom_body;
  controller_.sip.x_units = static_cast<std::uint16_t>((controller_.sip.x_units + 900) & 0x7FFF);  // no process listens
  const auto readings = next_process(3s);
  EXPECT_EQ(readings.front().origin, memory_.origin);
  EXPECT_NEAR(readings.front().T_odom_body.x_m, before.x_m + 0.9, 1e-9);
  EXPECT_NEAR(readings.front().T_odom_body.y_m, before.y_m, 1e-9);
  EXPECT_GT(readings.front().sigma_gap_m, 0.1) << "nobody knows the way it took";
  EXPECT_LT(readings.front().sigma_gap_m, 0.6);
  EXPECT_EQ(readings.back().sigma_gap_m, 0.0);
}

TEST_F(PioneerMemory, IsNotBelievedWhenTheRobotCannotHaveGoneSoFar) {
  controller_.sip.y_units = static_cast<std::uint16_t>((controller_.sip.y_units + 15000) & 0x7FFF);
  EXPECT_EQ(next_process(2s).front().origin, memory_.origin + 1);
}

TEST_F(PioneerMemory, IsOfNoUseOnceTheControllerRestarted) {
  controller_.restart();
  EXPECT_GT(next_process(1s).front().origin, memory_.origin);
}

TEST_F(PioneerMemory, IsOfNoUseForAnotherRobot) {
  memory_.odometer = "pioneer /dev/another";
  EXPECT_GT(next_process(1s).front().origin, memory_.origin);
}

TEST_F(PioneerMemory, OutlivesAStopThatLeavesTheSessionOpen) {
  first_.driver.close(PioneerDriver::Clock::now() + 50ms);
  robot_.serve();
  EXPECT_TRUE(controller_.open);
  ASSERT_TRUE(first_.driver.remember(memory_));
  EXPECT_EQ(next_process(1s).front().origin, memory_.origin);
}

TEST(PioneerMemoryOfAnEndedSession, IsNone) {
  FakeController controller;
  PtyRobot robot(controller);
  PioneerSettings settings;
  settings.device = robot.device();
  settings.keep_session = false;
  PioneerDriver driver(settings, {});
  OdometerMemory memory;
  EXPECT_FALSE(driver.remember(memory));
  for (auto now = PioneerDriver::Clock::time_point(1h); now < PioneerDriver::Clock::time_point(1h + 2s); now += 10ms) {
    robot.serve();
    if (now.time_since_epoch() % 100ms == 0ms) robot.send(controller.cycle());
    driver.turn(now);
  }
  EXPECT_TRUE(driver.remember(memory));
  driver.close(PioneerDriver::Clock::now() + 50ms);
  robot.serve();
  EXPECT_FALSE(controller.open);
  EXPECT_FALSE(driver.remember(memory));
}

}  // namespace
}  // namespace azimuth
