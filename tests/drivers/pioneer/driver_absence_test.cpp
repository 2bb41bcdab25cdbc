// The driver with a device that is absent, silent or closed, in virtual time.

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <memory>
#include <unistd.h>

#include "tests/drivers/pioneer/driver_bench.hpp"
#include "tests/drivers/pioneer/scripted_robot.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using pioneer::test::FakeController;
using pioneer::test::kEpochMinusMonotonic;
using pioneer::test::PtyRobot;
using pioneer::test::readable;
using testing::HasSubstr;
using Bench = pioneer::test::DriverBench;

/// Readings of the first two seconds after the robot was `away` and returned on another device node. `before` receives
/// the last reading before the absence.
std::vector<OdometryReading> replugged_readings(PioneerDriver::Clock::duration away, OdometryReading& before,
                                                std::uint64_t& reconnects) {
  const std::filesystem::path path = testing::TempDir() + "pioneer." + std::to_string(::getpid());
  FakeController controller;
  auto robot = std::make_unique<PtyRobot>(controller);
  std::filesystem::create_symlink(robot->device(), path);
  Bench bench(path.string());
  bench.run(1s, *robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  before = bench.readings.back();

  const PtyRobot keeps_the_name(controller);  // occupies the name, so that the next device gets another one
  robot.reset();
  std::filesystem::remove(path);
  bench.run(away);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);

  robot = std::make_unique<PtyRobot>(controller);  // the session is still open at the robot
  std::filesystem::create_symlink(robot->device(), path);
  bench.readings.clear();
  bench.run(2s, *robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  reconnects = bench.driver.state().reconnects();
  std::filesystem::remove(path);
  return bench.readings;
}

TEST(PioneerDriver, GoesOnWithinTwoSecondsOfAReplugOnAnotherNode) {
  OdometryReading before;
  std::uint64_t reconnects = 0;
  const auto readings = replugged_readings(1500ms, before, reconnects);
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(reconnects, 1U);
  EXPECT_EQ(readings.front().origin, before.origin);
  EXPECT_GT(readings.front().sequence, before.sequence);
  EXPECT_LT(readings.front().sigma_gap_m, 0.3);  // covers only the unobserved motion
}

TEST(PioneerDriver, BeginsANewOriginAfterALongAbsence) {
  OdometryReading before;
  std::uint64_t reconnects = 0;
  const auto readings = replugged_readings(10s, before, reconnects);
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(reconnects, 1U);
  EXPECT_NE(readings.front().origin, before.origin);
  EXPECT_GT(readings.front().sigma_gap_m, 0.0);
}

/// Counts how often the driver tries to open a missing device in a given time.
class Openings {
 public:
  explicit Openings(int error_number) {
    PioneerSettings settings;
    settings.device = "/dev/pioneer";
    driver = std::make_unique<PioneerDriver>(
        settings, kEpochMinusMonotonic, [this, error_number](const std::string& device) {
          ++count;
          return pioneer::OpenedLink(tl::unexpected(pioneer::LinkError{device, "open", error_number}));
        });
  }
  int in(PioneerDriver::Clock::duration time) {
    const int before = count;
    for (const auto end = now + time; now < end; now += 10ms) driver->turn(now);
    return count - before;
  }

  std::unique_ptr<PioneerDriver> driver;
  PioneerDriver::Clock::time_point now{1h};
  int count = 0;
};

TEST(PioneerDriver, TriesEagerlyForAWhileWhenSomethingWasPluggedIn) {
  Openings openings(ENOENT);
  openings.in(60s);
  EXPECT_LE(openings.in(3s), 3);
  openings.driver->wake(openings.now);
  EXPECT_EQ(openings.driver->due_in(openings.now), 0s);
  EXPECT_GE(openings.in(3s), 50);
  openings.in(20s);
  EXPECT_LE(openings.in(3s), 3);
}

TEST(PioneerDriver, KnowsHowLongADeviceThatIsThereHasSaidNothing) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  EXPECT_EQ(bench.driver.silent_for(bench.now), 0s);
  bench.run(12s);  // during several attempts to find a robot
  EXPECT_GE(bench.driver.silent_for(bench.now), 11s);
  EXPECT_LE(bench.driver.silent_for(bench.now), 12s);
  bench.run(2s, robot, controller);
  EXPECT_LE(bench.driver.silent_for(bench.now), 200ms);

  Openings away(ENOENT), forbidden(EACCES), hung(EIO);
  for (Openings* openings : {&away, &forbidden, &hung}) openings->in(20s);
  EXPECT_EQ(away.driver->silent_for(away.now), 0s);
  EXPECT_EQ(forbidden.driver->silent_for(forbidden.now), 0s);
  EXPECT_EQ(hung.driver->silent_for(hung.now), 20s);
}

TEST(PioneerDriver, ADeviceThatOnlyAnswersWithErrorsStaysSilentAndOneThatLeavesDoesNot) {
  FakeController controller;
  PtyRobot robot(controller);
  for (const auto& [error_number, stays] : {std::pair{EIO, true}, {ETIMEDOUT, true}, {ENOENT, false}, {ENXIO, false}}) {
    bool fails = false;
    PioneerSettings settings;
    settings.device = robot.device();
    PioneerDriver driver(settings, kEpochMinusMonotonic, [&fails, failure = error_number](const std::string& device) {
      return fails ? pioneer::OpenedLink(tl::unexpected(pioneer::LinkError{device, "open", failure}))
                   : pioneer::DeviceLink::open(device);
    });
    PioneerDriver::Clock::time_point now{1h};
    driver.turn(now);
    fails = true;
    driver.release(now, 1s);
    for (const auto end = now + 15s; now < end; now += 10ms) driver.turn(now);
    EXPECT_EQ(driver.silent_for(now), stays ? 15s : 0s) << error_number;
  }
}

TEST(PioneerDriver, AsksARobotItRefusedEverMoreSeldomUntilAnotherTakesItsPlace) {
  FakeController controller;
  controller.config.subclass = "hexapod";
  PtyRobot robot(controller);
  Bench bench(robot.device());
  const auto names_asked = [&controller] {
    return std::ranges::count(controller.commands, pioneer::test::ByteVector{pioneer::kSync2});
  };
  bench.run(10s, robot, controller);
  EXPECT_LE(names_asked(), 9);
  controller.commands.clear();
  bench.run(120s, robot, controller);
  EXPECT_GE(names_asked(), 3);
  EXPECT_LE(names_asked(), 5);
  controller.config.subclass = "p3dx-sh";
  bench.run(32s, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);

  controller.config.subclass = "hexapod";
  controller.restart();
  bench.run(60s, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  controller.config.subclass = "p3dx-sh";
  bench.driver.wake(bench.now);
  bench.run(1s, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << "something was plugged in";
}

TEST(PioneerDriver, StaysAwayFromADeviceItReleased) {
  FakeController controller;
  PtyRobot robot(controller);
  Bench bench(robot.device());
  bench.run(1s, robot, controller);
  ASSERT_EQ(bench.driver.state().connection, Connection::running);
  bench.driver.release(bench.now, 10s);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  EXPECT_THAT(bench.driver.state().trouble, HasSubstr("reset of its USB port"));
  bench.run(5s, robot, controller);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  bench.driver.wake(bench.now);
  bench.run(2s, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << readable(bench.events);
  bench.driver.release(bench.now, 3s);
  bench.run(5s, robot, controller);
  EXPECT_EQ(bench.driver.state().connection, Connection::running) << "nobody woke it";
}

}  // namespace
}  // namespace azimuth
