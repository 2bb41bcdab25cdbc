// Every fault of the simulator, on a robot that drives round the lab: the driver must recover, and its odometry must
// agree with the wheels.

#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include "sim/azimuth_sim/rover.hpp"
#include "sim/pioneer/fault_schedule.hpp"
#include "tests/robot/agreement.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

struct FaultCase {
  std::string fault, end;  // empty `end`: the fault ends by itself or is permanent
  bool before_session = false;
  double walk_m = 0.004;   // see expect_agreement()
  std::size_t sips = 350;  // least number, of 600
};
std::ostream& operator<<(std::ostream& out, const FaultCase& one) {
  return out << one.fault << (one.before_session ? " from the start" : "");
}

const FaultCase kFaultCases[] = {
    {"bad_config_checksum", "", true},
    {"bad_config_checksum", ""},
    {"noise=0.002", "noise=0"},
    {"noise=0.002", "", true},
    {"lose_bytes=0.002", "lose_bytes=0"},
    {"lose_bytes=0.002", "", true},
    {"lose_sips=0.2", "lose_sips=0"},
    {"lose_sips=0.9", "lose_sips=0", false, 0.004, 300},
    {"wrap15", "", true},
    {"wrap15=100", "", true},
    {"wrap16", "", true},
    {"wrap16=100", "", true},
    {"heading=179", "", true},
    {"heading=-179", "", true},
    {"reboot=0xFF", ""},
    {"reboot=0xFE", ""},
    {"reboot=0xFF", "", true},
    {"watchdog=1000", ""},
    {"hostbaud=refused", "", true},
    {"sonar", "sonar=off"},
    // On a saturated line at 9600 baud SIPs wait behind a CONFIGpac, which their stamps do not reveal.
    {"sonar", "", true, 0.03},
    {"estop", "", true},
    {"old_session", "", true},
    {"old_session=9600", "", true},
    {"old_session=19200", "", true},
    {"old_session=38400", "", true},
    {"old_session=57600", "", true},
    {"old_session=115200", "", true},
    {"unplug=0.2", ""},
    {"unplug=3", ""},
    {"unplug=2", "", true},
    {"silence=0.4", ""},
    {"silence=1", ""},
    {"silence=4", ""},
    {"silence=4", "", true},
    {"sip_id=0x32", "", true},
    {"sip_id=0x33", ""},
    {"gyro=always", "gyro=off"},
    {"gyro=off", "", true},
    {"encoder=always", "encoder=off"},
    {"encoder=off", "", true},
    {"jump=1.5", "jump=0"},
    {"stall=both", "stall=none"},
    {"bumpers=both", "bumpers=none"},
};

class FaultTest : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultTest, EndsRunningWithTheWheelsOdometry) {
  const Scenario scenario = lab(3, 40);
  const RobotSetup setup;
  sim::Rover rover(scenario, setup.model.track_mm / 1000.0);
  DrivenRobot robot(setup, rover);
  if (GetParam().before_session) robot.fault(GetParam().fault);
  robot.run(15s);
  if (!GetParam().before_session) robot.fault(GetParam().fault);
  robot.run(30s);
  if (!GetParam().end.empty()) robot.fault(GetParam().end);
  robot.run(15s);

  EXPECT_EQ(robot.state().connection, Connection::running) << robot.state().trouble;
  ASSERT_FALSE(robot.sightings.empty());
  EXPECT_LT(to_seconds(robot.now() - robot.sightings.back().taken_at), 0.5);
  EXPECT_GT(robot.sightings.size(), GetParam().sips);
  expect_agreement(robot.sightings, GetParam().walk_m);
  EXPECT_EQ(robot.state().refused_readings, 0U);
  const Agreement found = agreement(robot.sightings);
  RecordProperty("worst_mm", std::to_string(1000.0 * found.worst_m));
  // A driver that wakes without reason would load the processor. One turn per byte and the driver's timers are
  // acceptable.
  EXPECT_LT(robot.turns, robot.pioneer().counts().bytes_to_client + robot.pioneer().counts().bytes_from_client + 2000);
}

INSTANTIATE_TEST_SUITE_P(All, FaultTest, testing::ValuesIn(kFaultCases), PrintedName());

TEST(FaultCases, LeaveNoFaultOfTheSimulatorOut) {
  std::set<std::string> tried;
  for (const FaultCase& one : kFaultCases) tried.insert(one.fault.substr(0, one.fault.find('=')));
  std::istringstream help(sim::fault_help());
  for (std::string line; std::getline(help, line);) {
    const std::string name = line.substr(0, line.find(' '));
    EXPECT_TRUE(tried.contains(name)) << name;
  }
}

}  // namespace
}  // namespace azimuth::test
