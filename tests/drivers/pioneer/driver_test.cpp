// The driver with real descriptors in virtual time, without waiting.

#include "drivers/pioneer/driver.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include "tests/drivers/pioneer/driver_bench.hpp"
#include "tests/drivers/pioneer/scripted_robot.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::test::FakeController;
using pioneer::test::kEpochMinusMonotonic;
using pioneer::test::PtyRobot;
using pioneer::test::readable;
using pioneer::test::TcpRobot;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using Bench = pioneer::test::DriverBench;

TEST(PioneerDriver, ReadsOdometryFromASerialLine) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  ASSERT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  bench.readings.clear();
  controller.sip.battery_decivolts = 131;
  controller.sip.left_stall_and_rear_bumpers = 0b11;
  for (int i = 0; i < 10; ++i) {
    controller.sip.x_units = static_cast<std::uint16_t>(controller.sip.x_units + 50);
    bench.run(100ms, robot, controller);
  }
  ASSERT_EQ(bench.readings.size(), 10U);
  EXPECT_NEAR(bench.readings.back().T_odom_body.x_m, 0.5, 1e-12);
  for (std::size_t i = 1; i < bench.readings.size(); ++i) {
    EXPECT_EQ(bench.readings[i].sequence, bench.readings[i - 1].sequence + 1);
    EXPECT_EQ(bench.readings[i].stamp - bench.readings[i - 1].stamp, 100ms);
  }
  const auto age = bench.now.time_since_epoch() + kEpochMinusMonotonic - bench.readings.back().stamp.time_since_epoch();
  EXPECT_GE(age, 0ms);
  EXPECT_LE(age, 150ms);

  const PioneerState& state = bench.driver.state();
  EXPECT_EQ(state.name, "Tester");
  EXPECT_EQ(state.subclass, "p3dx-sh");
  EXPECT_EQ(state.firmware, "2.9");
  EXPECT_DOUBLE_EQ(state.battery_V, 13.1);
  EXPECT_TRUE(state.left_stall);
  EXPECT_FALSE(state.right_stall);
  EXPECT_EQ(state.bumpers.rear, 1);
  EXPECT_EQ(state.reconnects(), 0U);
  EXPECT_GT(state.packets, 10U);
  EXPECT_EQ(state.bad_checksums, 0U);
  EXPECT_STREQ(text(state.connection), "running");
}

TEST(PioneerDriver, ReadsOdometryOverTcpAndComesBackAfterAHangUp) {
  FakeController controller;
  TcpRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  ASSERT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  EXPECT_EQ(bench.driver.state().baud, 0);
  robot.hang_up();
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  bench.run(1500ms, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  EXPECT_EQ(bench.driver.state().reconnects(), 1U);
}

TEST(PioneerDriver, OpensNoDescriptorBeforeItsFirstTurn) {
  const Bench bench("/dev/null");
  EXPECT_EQ(bench.driver.descriptor(), -1);
  EXPECT_EQ(bench.driver.poll_events(), 0);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
}

TEST(PioneerDriver, TellsTroubleOnceAndTriesOn) {
  Bench bench("/nowhere/to/be/found");
  bench.run(20s);
  ASSERT_EQ(bench.events.size(), 1U);
  EXPECT_THAT(bench.events.front(), HasSubstr("/nowhere/to/be/found: open: No such file"));
  EXPECT_THAT(bench.driver.state().trouble, HasSubstr("No such file"));
  EXPECT_LE(bench.driver.due_in(bench.now), 1s);
}

TEST(PioneerDriver, RefusesWhatIsNoSerialLine) {
  Bench file("/dev/null");
  file.run(100ms);
  EXPECT_THAT(file.events, Contains(HasSubstr("not a serial line")));
  for (const char* device : {"tcp:", "tcp:localhost", "tcp:localhost:", "tcp:localhost:0", "tcp:localhost:99999",
                             "tcp:some.name:8101", "tcp:localhost:81x"}) {
    Bench bench(device);
    bench.run(10ms);
    EXPECT_THAT(bench.events, Contains(HasSubstr("not tcp:HOST:PORT"))) << device;
  }
}

TEST(PioneerDriver, IsStaleThenLostThenBack) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  ASSERT_EQ(bench.driver.state().connection, Connection::running);
  bench.run(400ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  bench.run(200ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::silent);
  EXPECT_EQ(bench.driver.state().stale, 1U);
  bench.run(1500ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::starting) << "already opened again";
  EXPECT_THAT(bench.driver.state().trouble, HasSubstr("no odometry from the robot"));
  bench.run(2500ms, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  EXPECT_THAT(bench.driver.state().trouble, IsEmpty());
}

TEST(PioneerDriver, BeginsANewOriginWhenTheControllerRestarts) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  const std::uint32_t origin = bench.readings.back().origin;
  controller.restart();
  robot.send(pioneer::encode_frame(pioneer::test::ByteVector{0xFF}).view());
  bench.run(2s, robot, controller);
  EXPECT_EQ(bench.driver.state().reboots, 1U);
  EXPECT_EQ(bench.readings.back().origin, origin + 1);
  EXPECT_THAT(bench.events, Contains(HasSubstr("the controller restarted")));
}

TEST(PioneerDriver, MarksAConfigWithAWrongChecksum) {
  FakeController controller;
  controller.config_checksum_is_wrong = true;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  EXPECT_TRUE(bench.driver.state().config_unverified);
  EXPECT_EQ(bench.driver.state().bad_checksums, 1U);
  EXPECT_EQ(bench.driver.state().skipped_bytes, 0U);
  EXPECT_THAT(bench.events, Contains(HasSubstr("wrong checksum")));
}

TEST(PioneerDriver, NamesARobotItDoesNotKnow) {
  FakeController controller;
  controller.config.subclass = "hexapod";
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(5s, robot, controller);
  EXPECT_THAT(bench.readings, IsEmpty());
  EXPECT_THAT(bench.events, Contains(HasSubstr("unknown kind \"hexapod\""))) << readable(bench.events);
  EXPECT_EQ(bench.events.size(), 1U) << "told once";
}

template <class Robot>
void expect_clean_end() {
  FakeController controller;
  Robot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  ASSERT_TRUE(controller.open);
  bench.driver.close(PioneerDriver::Clock::now() + 100ms);
  robot.serve();
  EXPECT_FALSE(controller.open);
  EXPECT_FALSE(controller.sends_encoder);
  EXPECT_EQ(bench.driver.state().connection, Connection::closed);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  bench.run(5s);
  EXPECT_EQ(bench.driver.state().connection, Connection::closed) << "for good";
  for (const auto& command : controller.commands) EXPECT_TRUE(pioneer::test::is_harmless(command));
}

TEST(PioneerDriver, EndsCleanlyOnASerialLine) { expect_clean_end<PtyRobot>(); }
TEST(PioneerDriver, EndsCleanlyOverTcp) { expect_clean_end<TcpRobot>(); }

TEST(PioneerDriver, EndsCleanlyWhenItGoesOutOfScope) {
  FakeController controller;
  PtyRobot robot(controller);
  {
    Bench bench(robot.device());
    bench.run(1s, robot, controller);
    ASSERT_TRUE(controller.open);
  }
  robot.serve();
  EXPECT_FALSE(controller.open);
}

TEST(PioneerDriver, AsksToBePolledForWhatItNeeds) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  EXPECT_EQ(bench.driver.poll_events(), POLLIN);
  pollfd ready{.fd = bench.driver.descriptor(), .events = bench.driver.poll_events(), .revents = 0};
  robot.send(controller.cycle());
  EXPECT_EQ(::poll(&ready, 1, 0), 1);
}

TEST(PioneerDriver, AllocatesNothingInTheSteadyState) {
  FakeController controller;
  PtyRobot robot(controller);
  PioneerSettings settings;
  settings.device = robot.device();
  PioneerDriver driver(settings, kEpochMinusMonotonic);
  PioneerDriver::Clock::time_point now{1h};
  OdometryReading reading;
  std::size_t in_turns = 0;
  std::uint64_t taken = 0;
  for (int i = 0; i < 3000; ++i, now += 10ms) {
    robot.serve();
    if (i % 10 == 0) {
      controller.sip.x_units = static_cast<std::uint16_t>(controller.sip.x_units + 40);
      controller.ticks.left_ticks += 40 * 128;
      controller.ticks.right_ticks += 40 * 128;
      robot.send(controller.cycle());
    }
    const std::size_t before = allocations();
    driver.turn(now);
    while (driver.take(reading)) ++taken;
    if (i > 500) in_turns += allocations() - before;
  }
  EXPECT_GT(taken, 280U);
  EXPECT_TRUE(driver.state().uses_ticks);
  EXPECT_EQ(in_turns, 0U);
}

}  // namespace
}  // namespace azimuth
