#include <nlohmann/json.hpp>

#include "tests/tools/doctor/fake_machine.hpp"
#include "tools/doctor/checks.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using Doctor = test::FakeMachine;

TEST_F(Doctor, ABareMachineIsExaminedToTheEnd) {
  const Findings findings = examine(machine, {});
  EXPECT_THAT(findings, Contains(IsFinding(Verdict::warning, "no USB serial adapter")));
  EXPECT_THAT(findings, Contains(IsFinding(Verdict::warning, "no camera")));
  EXPECT_EQ(worst(findings), Verdict::error);
  EXPECT_EQ(findings.back().check, "clock");
}

TEST_F(Doctor, AHealthyMachineHasNothingToMend) {
  write("/dev/ttyUSB0", "", 0666);
  write("/dev/video0", "", 0666);
  machine.video_nodes = [] { return std::vector<v4l2::VideoNode>{{.path = "/dev/video0", .card = "Cam"}}; };
  write("/sys/class/net/can0/type", "280\n");
  write("/sys/class/net/can0/flags", "0x40081\n");
  write("/sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "1\n");
  write("/etc/group", "dialout:x:54321:\nvideo:x:54321:\n");
  write("/proc/net/route", "heading\nlo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n");
  write("/sys/class/net/lo/flags", "0x1009\n");
  write("/proc/sys/net/core/rmem_max", "4194304\n");
  write("/proc/sys/net/core/rmem_default", "4194304\n");
  write("/sys/devices/system/cpu/online", "0-3\n");
  write("/proc/meminfo", "MemAvailable: 1000000 kB\n");
  machine.rtprio_limit = 99;
  machine.memlock_limit_bytes = std::numeric_limits<std::uint64_t>::max();
  machine.clock_synchronised = true;
  machine.free_bytes = [](const test::fs::path&) { return std::optional<std::uint64_t>(1'000'000'000'000); };
  machine.run = [](const std::vector<std::string>& command) {
    return ProgramOutcome{0, command[1] == "--version" ? "azimuthd 1.0.0\n" : ""};
  };
  test::fs::create_directory(machine.at("/logs"));
  ::chmod(machine.at("/logs").c_str(), 0777);
  const Plan plan{.devices = {},
                  .recording_folder = "/logs",
                  .min_free_mb = 500.0,
                  .configuration = "/etc/azimuth.toml",
                  .version = "1.0.0"};
  const Findings findings = examine(machine, plan);
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.verdict, Verdict::ok) << finding.check << ": " << finding.what;
    EXPECT_EQ(finding.fix, "") << finding.check;
  }
  EXPECT_GE(findings.size(), 15U);
}

TEST_F(Doctor, NamedDevicesReplaceThoseFound) {
  write("/dev/ttyUSB0", "", 0666);
  Plan plan;
  plan.devices = {"/dev/pioneer"};
  const Findings findings = examine(machine, plan);
  EXPECT_THAT(findings, Contains(IsFinding(Verdict::error, "/dev/pioneer is not there")));
  EXPECT_THAT(findings, Not(Contains(IsFinding(Verdict::ok, "ttyUSB0"))));
}

TEST_F(Doctor, EveryErrorSaysWhatMendsIt) {
  write("/dev/ttyUSB0", "", 0600);
  write("/dev/fw0", "", 0600);
  write("/proc/net/route", "heading\n");
  write("/sys/class/net/lo/flags", "0x0\n");
  Plan plan;
  plan.recording_folder = "/nowhere/logs";
  plan.v4l2_device = "first";
  plan.iidc_guid = "";
  plan.can_interface = "can0";
  for (const Finding& finding : examine(machine, plan)) {
    const bool is_well = finding.verdict < Verdict::warning;
    EXPECT_EQ(finding.fix.empty(), is_well) << finding.check << ": " << finding.what;
  }
}

TEST(Plan, TakesDeviceAndFolderFromTheConfiguration) {
  const char* const toml =
      "estimator = \"ekf\"\nmistake = 1\n[daemon.live]\nodometer = \"pioneer\"\n[daemon.pioneer]\nbaud = 9600\n"
      "device = \"/dev/pioneer\"\n[daemon.record]\nfolder = \"/logs\"\nmin_free_mb = 77\n";
  Plan plan;
  add_configured(toml, plan);
  EXPECT_EQ(plan.devices, std::vector<std::string>{"/dev/pioneer"});
  EXPECT_EQ(plan.recording_folder, "/logs");
  EXPECT_EQ(plan.min_free_mb, 77.0);
}

TEST(Plan, RelativePathsBeginAtTheConfigurationsFolder) {
  Plan plan;
  plan.configuration = "/etc/robot/azimuthd.toml";
  add_configured(
      "[daemon.live]\nodometer = \"pioneer\"\n[daemon.pioneer]\ndevice = \"links/pioneer\"\n"
      "[daemon.record]\nfolder = \"logs\"\n",
      plan);
  EXPECT_EQ(plan.devices, std::vector<std::string>{"/etc/robot/links/pioneer"});
  EXPECT_EQ(plan.recording_folder, "/etc/robot/logs");

  plan = {};
  plan.configuration = "/etc/robot/azimuthd.toml";
  add_configured("[daemon.live]\nodometer = \"pioneer\"\n[daemon.pioneer]\ndevice = \"tcp:robot:8101\"\n", plan);
  EXPECT_EQ(plan.devices, std::vector<std::string>{"tcp:robot:8101"}) << "an address is no path";
}

TEST(Plan, TakesCameraAndCanInterfaceFromTheConfiguration) {
  Plan plan;
  add_configured(
      "[daemon.live]\nodometer = \"can\"\ncamera = \"v4l2\"\n[daemon.can]\ninterface = \"can7\"\n"
      "[daemon.v4l2]\ndevice = \"serial:A1\"\n[daemon.iidc]\nguid = \"1\"\n",
      plan);
  EXPECT_EQ(plan.can_interface, "can7");
  EXPECT_EQ(plan.v4l2_device, "serial:A1");
  EXPECT_EQ(plan.iidc_guid, std::nullopt) << "not the camera that is used";
  EXPECT_FALSE(plan.wants_serial);
  EXPECT_TRUE(plan.wants_camera);

  plan = {};
  add_configured("[daemon.live]\nodometer = \"can\"\ncamera = \"v4l2\"\n", plan);
  EXPECT_EQ(plan.can_interface, "can0") << "the daemon's default";
  EXPECT_EQ(plan.v4l2_device, "first");

  plan = {};
  add_configured("[daemon.live]\nodometer = \"pioneer\"\ncamera = \"iidc\"\n", plan);
  EXPECT_EQ(plan.can_interface, std::nullopt);
  EXPECT_EQ(plan.iidc_guid, "");
  EXPECT_TRUE(plan.wants_serial);

  plan = {};
  add_configured("[daemon.live]\nodometer = \"lcm\"\ncamera = \"shared\"\n", plan);
  EXPECT_FALSE(plan.wants_serial);
  EXPECT_FALSE(plan.wants_camera);
}

TEST_F(Doctor, LooksWhereTheConfigurationPutsThreads) {
  write("/sys/devices/system/cpu/online", "0-1\n");
  Plan plan;
  add_configured("[daemon.realtime]\nlock_memory = false\nsource_cpu = -1\nperception_cpu = 1\nrecorder_cpu = 7\n",
                 plan);
  const Findings findings = examine(machine, plan);
  EXPECT_THAT(findings, Contains(IsFinding(Verdict::warning, "2 cores; daemon.realtime.recorder_cpu is 7, and there")));
}

TEST_F(Doctor, NamesWhatASmallBoardLacks) {
  write("/sys/class/hwmon/hwmon0/name", "rpi_volt\n");
  write("/sys/class/hwmon/hwmon0/in0_lcrit_alarm", "1\n");
  write("/sys/class/thermal/cooling_device0/type", "cpufreq-cpu0\n");
  write("/sys/class/thermal/cooling_device0/cur_state", "1\n");
  write("/proc/meminfo", "MemAvailable: 1000 kB\n");
  for (const char* lacking : {"voltage is too low", "because it is hot", "1 MB of memory"})
    EXPECT_THAT(examine(machine, {}), Contains(IsFinding(Verdict::warning, lacking)));
}

TEST_F(Doctor, WhatTheConfigurationDoesWithoutIsNotMissed) {
  Plan plan;
  plan.wants_serial = plan.wants_camera = false;
  const Findings findings = examine(machine, plan);
  EXPECT_THAT(findings, Not(Contains(IsFinding(Verdict::warning, "no USB serial adapter"))));
  EXPECT_THAT(findings, Contains(IsFinding(Verdict::ok, "no camera is plugged in")));
}

TEST_F(Doctor, LooksAtTheInstalledConfigurationUnlessAnotherIsGiven) {
  Plan plan;
  add_installed(machine, plan);
  EXPECT_EQ(plan.configuration, "") << "there is none yet";
  write(std::string(kInstalledConfiguration));
  add_installed(machine, plan);
  EXPECT_EQ(plan.configuration, "/etc/azimuthd/azimuthd.toml");
  plan.configuration = "mine.toml";
  add_installed(machine, plan);
  EXPECT_EQ(plan.configuration, "mine.toml");
}

TEST(Plan, WhatIsGivenGoesBeforeTheConfiguration) {
  Plan plan;
  plan.devices = {"/dev/other"};
  plan.recording_folder = "/elsewhere";
  add_configured("[daemon.live]\nodometer = \"pioneer\"\n[daemon.record]\nfolder = \"/logs\"\nmin_free_mb = 77\n",
                 plan);
  EXPECT_EQ(plan.devices, std::vector<std::string>{"/dev/other"});
  EXPECT_EQ(plan.recording_folder, "/elsewhere");
  EXPECT_EQ(plan.min_free_mb, 500.0);
}

TEST(Plan, ASilentConfigurationLeavesItAsItIs) {
  for (const char* toml : {"", "not toml at all [", "[daemon.pioneer]\ndevice = \"/dev/x\"\n"}) {
    Plan plan;
    add_configured(toml, plan);
    EXPECT_TRUE(plan.devices.empty()) << "no odometer is configured";
    EXPECT_EQ(plan.recording_folder, "");
    EXPECT_TRUE(plan.wants_serial && plan.wants_camera);
  }
}

TEST(Findings, AreAsGraveAsTheGravest) {
  EXPECT_EQ(worst({}), Verdict::ok);
  EXPECT_EQ(worst({{"a", Verdict::ok, "", ""}, {"b", Verdict::unknown, "", ""}}), Verdict::unknown);
  EXPECT_EQ(worst({{"a", Verdict::error, "", ""}, {"b", Verdict::warning, "", ""}}), Verdict::error);
}

TEST(Findings, AreTextForReaders) {
  EXPECT_EQ(text({{"clock", Verdict::ok, "good", ""}, {"route", Verdict::error, "none", "first\nsecond"}}),
            "ok       clock       good\n"
            "error    route       none\n"
            "                     $ first\n"
            "                     $ second\n");
}

TEST(Findings, AreJsonForPrograms) {
  const auto json = nlohmann::json::parse(
      to_json({{"clock", Verdict::ok, "good", ""}, {"route", Verdict::warning, "\xff in \"quotes\"", "do it"}}));
  EXPECT_EQ(json["verdict"], "warning");
  EXPECT_EQ(json["findings"].size(), 2U);
  EXPECT_TRUE(json["findings"][0]["fix"].is_null());
  EXPECT_EQ(json["findings"][1]["check"], "route");
  EXPECT_EQ(json["findings"][1]["fix"], "do it");
}

}  // namespace
}  // namespace azimuth
