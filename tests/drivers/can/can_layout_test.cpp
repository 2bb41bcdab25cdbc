#include "drivers/can/can_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/drivers/can/shipped_dbc.hpp"

namespace azimuth {
namespace {

using test::shipped_dbc;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

CanSettings ticks_by_dbc() {
  CanSettings settings;
  settings.left = "Wheels.LeftTicks";
  settings.right = "Wheels.RightTicks";
  settings.ticks_per_m = 20000;
  settings.track_m = 0.4;
  return settings;
}

std::vector<std::string> errors_of(const CanSettings& settings, const Dbc* dbc = nullptr) {
  std::vector<std::string> lines;
  const FileResult<CanLayout> layout = find_can_layout(settings, dbc);
  if (!layout)
    for (const FileError& error : layout.error()) lines.push_back(error.text());
  return lines;
}

TEST(CanLayout, FindsSignalsInADbcFile) {
  const Dbc dbc = shipped_dbc();
  CanSettings settings = ticks_by_dbc();
  settings.battery = "Power.Voltage";
  settings.emergency_stop = "Wheels.EmergencyStop";
  settings.right_reversed = true;
  const FileResult<CanLayout> layout = find_can_layout(settings, &dbc);
  ASSERT_TRUE(layout) << text(layout.error());
  ASSERT_EQ(layout->motion.size(), 2U);
  EXPECT_EQ(layout->motion[0].signal, dbc.find("Wheels.LeftTicks")->signal);
  EXPECT_DOUBLE_EQ(layout->motion[0].unit, 1.0 / 20000);
  EXPECT_DOUBLE_EQ(layout->motion[1].unit, -1.0 / 20000);
  EXPECT_DOUBLE_EQ(layout->motion[0].fastest_per_s, 2.2 + 6.3 * 0.2);
  EXPECT_EQ(layout->battery, dbc.find("Power.Voltage")->signal);
  EXPECT_EQ(layout->emergency_stop, dbc.find("Wheels.EmergencyStop")->signal);
  EXPECT_FALSE(layout->bumper);
  EXPECT_THAT(layout->ids(), ElementsAre(CanId{385, false}, CanId{386, false}));
}

TEST(CanLayout, FindsDescribedSignalsFirst) {
  const Dbc dbc = shipped_dbc();
  CanSettings settings = ticks_by_dbc();
  settings.signals = {
      {.name = "Wheels.LeftTicks", .id = 0x1ABCDEF, .extended = true, .multiplexer = "Page", .multiplexer_value = 2},
      {.name = "Page", .id = 0x1ABCDEF, .extended = true, .start_bit = 60, .length_bits = 4}};
  const FileResult<CanLayout> layout = find_can_layout(settings, &dbc);
  ASSERT_TRUE(layout) << text(layout.error());
  EXPECT_EQ(layout->motion[0].signal.frame, (CanId{0x1ABCDEF, true}));
  EXPECT_EQ(layout->motion[0].signal.multiplexer, (CanSignal::Multiplexer{{60, 4}, 2}));
  EXPECT_THAT(layout->ids(), UnorderedElementsAre(CanId{385, false}, CanId{0x1ABCDEF, true}));
}

TEST(CanLayout, SpeedsHaveTheUnitOfTheirWheels) {
  CanSettings settings = ticks_by_dbc();
  const Dbc dbc = shipped_dbc();
  settings.odometry = CanOdometryKind::speeds;
  settings.wheel_radius_m = 0.1;
  EXPECT_DOUBLE_EQ(find_can_layout(settings, &dbc)->motion[0].unit, 1.0);
  settings.speed_unit = CanSpeedUnit::rpm;
  EXPECT_DOUBLE_EQ(find_can_layout(settings, &dbc)->motion[0].unit, 0.1 * 2.0 * std::numbers::pi / 60.0);
  settings.speed_unit = CanSpeedUnit::rad_per_s;
  EXPECT_DOUBLE_EQ(find_can_layout(settings, &dbc)->motion[0].unit, 0.1);
}

TEST(CanLayout, NamesEverythingThatIsMissing) {
  EXPECT_THAT(errors_of(CanSettings{}),
              UnorderedElementsAre(HasSubstr("daemon.can.left: is missing"), HasSubstr("daemon.can.right: is missing"),
                                   HasSubstr("daemon.can.ticks_per_m"), HasSubstr("daemon.can.track_m")));
  CanSettings pose;
  pose.odometry = CanOdometryKind::pose;
  EXPECT_THAT(errors_of(pose), UnorderedElementsAre(HasSubstr("daemon.can.x:"), HasSubstr("daemon.can.y:"),
                                                    HasSubstr("daemon.can.heading:")));
}

TEST(CanLayout, NamesSignalsThatDoNotExistOrCannotBeUsed) {
  const Dbc dbc = shipped_dbc();
  CanSettings settings = ticks_by_dbc();
  settings.left = "Wheels.Lefty";
  settings.signals = {{.name = "bad", .id = 0x800}, {.name = "muxed", .id = 1, .multiplexer = "bad"}};
  settings.right = "bad";
  settings.battery = "muxed";
  EXPECT_THAT(errors_of(settings, &dbc),
              UnorderedElementsAre(HasSubstr("\"Wheels.Lefty\" in daemon.can.signal or in simulated-can.dbc"),
                                   HasSubstr("extended one?"), HasSubstr("no multiplexer \"bad\"")));
}

}  // namespace
}  // namespace azimuth
