// The base that azimuth-sim simulates on a CAN bus, decoded by the driver and by the shipped DBC file.

#include "sim/azimuth_sim/can_base.hpp"

#include <gtest/gtest.h>

#include "drivers/can/can_odometer.hpp"
#include "sim/azimuth_sim/simulation.hpp"
#include "tests/drivers/can/shipped_dbc.hpp"

namespace azimuth::sim {
namespace {

using namespace std::chrono_literals;

/// The settings of config/can-robot.toml.
CanSettings settings() {
  CanSettings settings;
  settings.left = "Wheels.LeftTicks";
  settings.right = "Wheels.RightTicks";
  settings.ticks_per_m = 20000;
  settings.track_m = 0.357142857;
  return settings;
}

CanLayout layout_in(const Dbc& dbc) {
  FileResult<CanLayout> layout = find_can_layout(settings(), &dbc);
  EXPECT_TRUE(layout) << text(layout.error());
  return layout ? *layout : CanLayout{};
}

/// A drive, received from the bus.
class Drive {
 public:
  explicit Drive(std::string_view faults = {})
      : simulation_({lab(5, 1), PioneerModel{}, {}, std::nullopt, true}), dbc(azimuth::test::shipped_dbc()) {
    if (!faults.empty()) apply(faults);
  }
  void apply(std::string_view fault) { parse_fault(fault).value().apply(simulation_.pioneer()); }
  void run(Duration duration) {
    for (const Stamp end = now_ + duration; now_ < end;) {
      now_ += 20ms;
      output.clear();
      simulation_.advance(now_, output);
      if (!output.odometry.empty()) by_wheels = output.odometry.back();
      for (const CanFrame& frame : output.can_frames) {
        ++frames;
        const DeviceClock::time_point at(now_.time_since_epoch());
        if (const auto reading = odometer.add(frame, at)) newest = *reading;
        read("Power.Voltage", frame, battery_v);
        read("Wheels.EmergencyStop", frame, emergency_stop);
        read("Wheels.Bumper", frame, bumper);
        read("Wheels.Counter", frame, counter);
        read("Wheels.LeftTicks", frame, left_ticks);
      }
    }
  }

 private:
  void read(const char* name, const CanFrame& frame, double& into) const {
    const CanDecoded decoded = decode(dbc.find(name)->signal, frame);
    if (decoded.found == CanFound::value) into = decoded.value.value;
  }

  Simulation simulation_;
  Stamp now_{};

 public:
  Dbc dbc;
  CanOdometer odometer{layout_in(dbc), settings(), Duration{0}};
  SimulationOutput output;
  OdometryReading newest, by_wheels;
  std::size_t frames = 0;
  double battery_v = 0.0, emergency_stop = -1.0, bumper = -1.0, counter = -1.0, left_ticks = 0.0;
};

TEST(CanBase, ItsTicksTellTheWayOfTheWheels) {
  Drive drive;
  drive.run(60s);
  EXPECT_GT(drive.by_wheels.T_odom_body.position().norm(), 0.5);
  const Pose2 difference = inverse(drive.by_wheels.T_odom_body) * drive.newest.T_odom_body;
  EXPECT_LT(difference.position().norm(), 0.02);
  EXPECT_NEAR(difference.heading_rad, 0.0, 0.01);
  EXPECT_LT(drive.left_ticks, -7e6) << "wrapped on the way";
  EXPECT_EQ(drive.odometer.restarts(), 0U);
  EXPECT_EQ(drive.odometer.missed(), 0U);
  EXPECT_EQ(drive.odometer.malformed(), 0U);
}

TEST(CanBase, SendsAtTheRatesItSays) {
  Drive drive;
  drive.run(10s);
  EXPECT_NEAR(static_cast<double>(drive.frames), 10 * (50 + 2), 2.0);
  EXPECT_EQ(drive.counter, 500 % 256);
}

TEST(CanBase, TellsOfBatteryBumpersAndEmergencyStop) {
  Drive drive;
  drive.run(1s);
  EXPECT_DOUBLE_EQ(drive.battery_v, 12.8);
  EXPECT_EQ(drive.emergency_stop, 0.0);
  EXPECT_EQ(drive.bumper, 0.0);
  drive.apply("estop");
  drive.apply("bumpers=front");
  drive.run(100ms);
  EXPECT_EQ(drive.emergency_stop, 1.0);
  EXPECT_EQ(drive.bumper, 1.0);
}

TEST(CanBase, ASilenceLosesNoWay) {
  Drive drive;
  drive.run(10s);
  const std::uint32_t origin = drive.newest.origin;
  drive.apply("silence=2");
  const std::size_t before = drive.frames;
  drive.run(1900ms);
  EXPECT_EQ(drive.frames, before);
  drive.run(10s);
  EXPECT_EQ(drive.newest.origin, origin);
  EXPECT_LT((inverse(drive.by_wheels.T_odom_body) * drive.newest.T_odom_body).position().norm(), 0.05);
}

TEST(CanBase, ARestartIsANewOrigin) {
  Drive drive;
  drive.run(10s);
  const std::uint32_t origin = drive.newest.origin;
  drive.apply("reboot");
  drive.run(1s);
  EXPECT_EQ(drive.newest.origin, origin + 1);
}

TEST(CanSender, AnInterfaceThatDoesNotExistIsAnErrorWithItsName) {
  CanSender sender("nocan0");
  const auto opened = sender.open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().front().file, "nocan0");
  const std::vector<CanFrame> frames(3);
  sender.send(frames);
  EXPECT_EQ(sender.lost(), 3U);
}

}  // namespace
}  // namespace azimuth::sim
