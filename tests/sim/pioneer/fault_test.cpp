// The names of faults on the command line, and their timing.

#include <gtest/gtest.h>

#include "sim/pioneer/fault_schedule.hpp"

namespace azimuth::sim {
namespace {

std::string parsed(std::string_view text) {
  const auto fault = parse_fault(text);
  return fault ? fault->text() : "refused: " + fault.error();
}

Fault fault(std::string_view text) { return parse_fault(text).value(); }

std::string texts(const std::vector<Fault>& faults) {
  std::string all;
  for (const Fault& one : faults) all += one.text() + " ";
  return all;
}

TEST(Fault, ReadsNamesAndValues) {
  EXPECT_EQ(parsed("noise=0.01"), "noise=0.01");
  EXPECT_EQ(parsed("noise"), "noise=0.001");
  EXPECT_EQ(parsed("bad_config_checksum"), "bad_config_checksum=on");
  EXPECT_EQ(parsed("reboot=0xFE"), "reboot=0xFE");
  EXPECT_EQ(parsed("gyro=off"), "gyro=off");
  EXPECT_EQ(parsed("heading=-90"), "heading=-90");
}

TEST(Fault, RefusesWhatItDoesNotUnderstand) {
  for (const char* text : {"", "nosie=1", "noise=", "noise=2", "noise=-0.1", "noise=nan", "noise=1x", "reboot=0xFD",
                           "reboot=", "unplug=1e9", "bad_config_checksum=1", "=3"}) {
    EXPECT_TRUE(parsed(text).starts_with("refused: ")) << text << " was read as " << parsed(text);
  }
}

TEST(Fault, HelpNamesEveryFault) {
  for (const char* name :
       {"bad_config_checksum", "noise", "lose_bytes", "lose_sips", "wrap15", "wrap16", "heading", "reboot", "watchdog",
        "hostbaud", "sonar", "old_session", "unplug", "silence", "sip_id", "gyro", "encoder", "jump"}) {
    EXPECT_NE(("\n" + fault_help()).find("\n" + std::string(name) + " "), std::string::npos) << name;
    EXPECT_FALSE(parsed(name).starts_with("refused")) << name << " has a usual value";
  }
}

TEST(FaultSchedule, TimedFaultsAreReadStrictly) {
  const auto timed = parse_timed_fault("12.5:reboot");
  ASSERT_TRUE(timed);
  EXPECT_EQ((*timed).at, stamp_from_us(12'500'000));
  for (const char* text : {"", "reboot", "5", "5:", ":reboot", "x:reboot", "-1:reboot", "5 :reboot", "nan:reboot"}) {
    EXPECT_FALSE(parse_timed_fault(text)) << text;
  }
}

TEST(FaultSchedule, GivesEachOnceInOrder) {
  FaultSchedule schedule({{stamp_from_us(20), fault("reboot")}, {stamp_from_us(10), fault("noise=1")}}, {}, {});
  EXPECT_EQ(schedule.due(), stamp_from_us(10));
  EXPECT_EQ(texts(schedule.take(stamp_from_us(9))), "");
  EXPECT_EQ(texts(schedule.take(stamp_from_us(10))), "noise=1 ");
  EXPECT_EQ(texts(schedule.take(stamp_from_us(30))), "reboot=0xFF ");
  EXPECT_EQ(schedule.due(), Stamp::max());
}

TEST(FaultSchedule, CyclesThroughItsListForEver) {
  FaultSchedule schedule({}, {fault("noise=1"), fault("noise=0"), fault("unplug=3")}, Duration(100));
  EXPECT_EQ(schedule.due(), stamp_from_us(100));
  EXPECT_EQ(texts(schedule.take(stamp_from_us(250))), "noise=1 noise=0 ");
  EXPECT_EQ(texts(schedule.take(stamp_from_us(500))), "unplug=3 noise=1 noise=0 ");
  EXPECT_EQ(schedule.due(), stamp_from_us(600));
}

TEST(FaultSchedule, EmptyNeverComes) { EXPECT_EQ(FaultSchedule().due(), Stamp::max()); }

}  // namespace
}  // namespace azimuth::sim
