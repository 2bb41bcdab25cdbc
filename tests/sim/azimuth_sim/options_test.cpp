#include "sim/azimuth_sim/options.hpp"

#include <gtest/gtest.h>

namespace azimuth::sim {
namespace {

ParsedOptions parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "azimuth-sim");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, DefaultsAreARobotInTheLab) {
  const ParsedOptions parsed = parse({"--device", "robot"});
  ASSERT_FALSE(parsed.exit_code);
  EXPECT_EQ(parsed.options.simulation.scenario.name, "lab");
  EXPECT_EQ(parsed.options.simulation.model.subclass, "p3dx-sh");
  EXPECT_EQ(parsed.options.simulation.model.start_baud, 9600);
  EXPECT_TRUE(parsed.options.simulation.model.baud_resets);
  EXPECT_EQ(parsed.options.device, "robot");
  EXPECT_EQ(parsed.options.speed, 1.0);
}

TEST(Options, EverythingArrivesWhereItBelongs) {
  const ParsedOptions parsed = parse({"--tcp",
                                      "8101",
                                      "--scenario",
                                      "hall",
                                      "--seed",
                                      "7",
                                      "--laps",
                                      "5",
                                      "--subclass",
                                      "p3at-sh",
                                      "--baud",
                                      "38400",
                                      "--keep-baud",
                                      "--gyro",
                                      "--no-identities",
                                      "--clutter",
                                      "0.5",
                                      "--speed",
                                      "2",
                                      "--duration",
                                      "60",
                                      "--fault",
                                      "noise=0.01",
                                      "--fault",
                                      "wrap15",
                                      "--at",
                                      "5:reboot",
                                      "--every",
                                      "10",
                                      "--cycle",
                                      "unplug=2,silence=1"});
  ASSERT_FALSE(parsed.exit_code);
  const Options& options = parsed.options;
  EXPECT_EQ(options.tcp_port, 8101);
  EXPECT_TRUE(options.device.empty());
  EXPECT_EQ(options.simulation.scenario.name, "hall");
  EXPECT_EQ(options.simulation.scenario.seed, 7U);
  EXPECT_EQ(options.simulation.scenario.path.size(), hall(7, 5).path.size());
  EXPECT_FALSE(options.simulation.scenario.sensor.identities);
  EXPECT_EQ(options.simulation.scenario.sensor.clutter_per_set, 0.5);
  EXPECT_EQ(options.simulation.model.subclass, "p3at-sh");
  EXPECT_EQ(options.simulation.model.start_baud, 38400);
  EXPECT_FALSE(options.simulation.model.baud_resets);
  EXPECT_TRUE(options.simulation.model.has_gyro);
  ASSERT_EQ(options.faults.size(), 2U);
  FaultSchedule schedule = options.simulation.faults;
  const std::vector<Fault> faults = schedule.take(stamp_from_us(20'000'000));
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].text(), "reboot=0xFF");
  EXPECT_EQ(faults[1].text(), "unplug=2");
  EXPECT_EQ(faults[2].text(), "silence=1");
}

TEST(Options, RefusesWhatCannotBe) {
  const std::vector<std::vector<const char*>> refused{
      {},
      {"--device", "a", "--tcp", "1"},
      {"--tcp", "70000"},
      {"--tcp", "x"},
      {"--device", "a", "--scenario", "moon"},
      {"--device", "a", "--subclass", "p4dx"},
      {"--device", "a", "--baud", "1200"},
      {"--device", "a", "--fault", "nonsense"},
      {"--device", "a", "--at", "reboot"},
      {"--device", "a", "--every", "5"},
      {"--device", "a", "--cycle", "reboot"},
      {"--device", "a", "--speed", "0"},
      {"--device", "a", "--unknown"},
      {"--device", "a", "--stand-still", "--end-at-arrival"},
      {"--device", "a", "--stand-still", "--laps", "2"},
  };
  for (const auto& arguments : refused) {
    testing::internal::CaptureStderr();
    const ParsedOptions parsed = parse(arguments);
    EXPECT_FALSE(testing::internal::GetCapturedStderr().empty());
    EXPECT_EQ(parsed.exit_code, 2) << (arguments.empty() ? "" : arguments.back());
  }
}

TEST(Options, ACanBaseNeedsNoSerialLine) {
  const ParsedOptions parsed = parse({"--can", "vcan0"});
  EXPECT_FALSE(parsed.exit_code);
  EXPECT_EQ(parsed.options.can_interface, "vcan0");
  EXPECT_TRUE(parsed.options.simulation.has_can_base);
  EXPECT_FALSE(parsed.options.tcp_port);
  EXPECT_FALSE(parse({"--can", "vcan0", "--tcp", "0"}).exit_code);
  EXPECT_FALSE(parse({"--tcp", "0"}).options.simulation.has_can_base);
}

TEST(Options, TheRobotMayStandUntilAClientDrives) {
  EXPECT_EQ(parse({"--tcp", "0"}).options.simulation.left_alone, LeftAlone::follows_its_path);
  EXPECT_EQ(parse({"--tcp", "0", "--stand-still"}).options.simulation.left_alone, LeftAlone::stands);
}

TEST(Options, HelpListsTheFaults) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(parse({"--help"}).exit_code, 0);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("bad_config_checksum"), std::string::npos);
}

}  // namespace
}  // namespace azimuth::sim
