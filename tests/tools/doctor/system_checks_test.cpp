#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::ElementsAre;
using testing::HasSubstr;

class SystemChecks : public test::FakeMachine {
 protected:
  void governor(int cpu, const std::string& name) {
    write("/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/cpufreq/scaling_governor", name + "\n");
  }
  void answers(int exit_code, const std::string& output) {
    machine.run = [this, exit_code, output](const std::vector<std::string>& command) {
      asked = command;
      return ProgramOutcome{exit_code, output};
    };
  }
  std::vector<std::string> asked;
};

TEST_F(SystemChecks, RealtimePriority) {
  const Finding none = check_realtime_priority(machine);
  EXPECT_THAT(none, IsFinding(Verdict::warning, "not allowed to ada"));
  EXPECT_THAT(none.fix, HasSubstr("ada - rtprio 60"));
  machine.rtprio_limit = 60;
  EXPECT_THAT(check_realtime_priority(machine), IsFinding(Verdict::ok, "allowed"));
  machine.rtprio_limit.reset();
  EXPECT_THAT(check_realtime_priority(machine), IsFinding(Verdict::unknown, "only known when run as ada"));
  machine.rtprio_limit = 0;
  machine.account.uid = 0;
  EXPECT_THAT(check_realtime_priority(machine), IsFinding(Verdict::ok, "root"));
}

TEST_F(SystemChecks, MemoryLock) {
  const Finding some = check_memory_lock(machine);
  EXPECT_THAT(some, IsFinding(Verdict::warning, "locking all memory: not allowed"));
  EXPECT_THAT(some.fix, HasSubstr("ada - memlock unlimited"));
  machine.memlock_limit_bytes = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THAT(check_memory_lock(machine), IsFinding(Verdict::ok, "allowed"));
}

TEST_F(SystemChecks, LimitsOfTheServiceCountBeforeThoseOfALogin) {
  write("/usr/lib/systemd/system/azimuthd.service", "[Service]\nLimitRTPRIO=60\n#LimitMEMLOCK=infinity\n");
  EXPECT_THAT(check_realtime_priority(machine), IsFinding(Verdict::ok, "azimuthd.service sets LimitRTPRIO"));
  EXPECT_THAT(check_memory_lock(machine), IsFinding(Verdict::warning, "")) << "a comment sets nothing";
}

TEST_F(SystemChecks, Governor) {
  EXPECT_THAT(check_cpu_governor(machine), IsFinding(Verdict::ok, "not scaled"));
  governor(0, "performance");
  governor(1, "performance");
  EXPECT_THAT(check_cpu_governor(machine), IsFinding(Verdict::ok, "full speed"));
  governor(1, "powersave");
  const Finding mixed = check_cpu_governor(machine);
  EXPECT_THAT(mixed, IsFinding(Verdict::warning, "1 processors follow the governor \"powersave\""));
  EXPECT_THAT(mixed.fix, HasSubstr("echo performance | sudo tee"));
}

TEST_F(SystemChecks, RecordingFolder) {
  EXPECT_THAT(check_recording_folder(machine, "", 500.0), IsFinding(Verdict::ok, "nothing is recorded"));
  test::fs::create_directory(machine.at("/var"));
  ::chmod(machine.at("/var").c_str(), 0755);
  const Finding missing = check_recording_folder(machine, "/var/log", 500.0);
  EXPECT_THAT(missing, IsFinding(Verdict::error, "/var/log does not exist, and ada may not make it"));
  EXPECT_EQ(missing.fix, "sudo install -d -o ada -m 0755 /var/log");
  ::chmod(machine.at("/var").c_str(), 0777);
  EXPECT_THAT(check_recording_folder(machine, "/var/log", 500.0), IsFinding(Verdict::ok, "the daemon will make it"));

  test::fs::create_directory(machine.at("/var/log"));
  ::chmod(machine.at("/var/log").c_str(), 0755);
  EXPECT_THAT(check_recording_folder(machine, "/var/log", 500.0), IsFinding(Verdict::error, "ada may not write"));
  ::chmod(machine.at("/var/log").c_str(), 0777);
  EXPECT_THAT(check_recording_folder(machine, "/var/log", 500.0), IsFinding(Verdict::unknown, "does not say"));
  const auto with_free_mb = [&](std::uint64_t free_mb) {
    machine.free_bytes = [free_mb](const test::fs::path&) { return std::optional(free_mb * 1'000'000); };
    return check_recording_folder(machine, "/var/log", 500.0);
  };
  EXPECT_THAT(with_free_mb(1000), IsFinding(Verdict::ok, "1000 MB are free"));
  EXPECT_THAT(with_free_mb(999), IsFinding(Verdict::warning, "recording leaves 500 MB free"));
  EXPECT_THAT(with_free_mb(499), IsFinding(Verdict::error, "499 MB are free"));
  write("/file");
  EXPECT_THAT(check_recording_folder(machine, "/file", 500.0), IsFinding(Verdict::error, "is not a folder"));
}

TEST_F(SystemChecks, Clock) {
  EXPECT_THAT(check_clock(machine), IsFinding(Verdict::unknown, ""));
  machine.clock_synchronised = false;
  EXPECT_THAT(check_clock(machine), IsFinding(Verdict::warning, "not synchronised"));
  EXPECT_EQ(check_clock(machine).fix, "sudo timedatectl set-ntp true");
  machine.clock_synchronised = true;
  EXPECT_THAT(check_clock(machine), IsFinding(Verdict::ok, "is synchronised"));
}

TEST_F(SystemChecks, DaemonVersion) {
  EXPECT_THAT(check_daemon_version(machine, "1.2.3"), IsFinding(Verdict::error, "cannot be started"));
  answers(0, "azimuthd 1.2.3\n");
  EXPECT_THAT(check_daemon_version(machine, "1.2.3"), IsFinding(Verdict::ok, "azimuthd 1.2.3"));
  EXPECT_THAT(asked, ElementsAre("azimuthd", "--version"));
  EXPECT_THAT(check_daemon_version(machine, "1.2.4"),
              IsFinding(Verdict::warning, "azimuthd 1.2.3 beside azimuth 1.2.4"));
  answers(139, "");
  EXPECT_THAT(check_daemon_version(machine, "1.2.3"), IsFinding(Verdict::error, "cannot be started"));
}

TEST_F(SystemChecks, ConfigurationFile) {
  EXPECT_THAT(check_configuration(machine, ""), IsFinding(Verdict::unknown, "no configuration is given"));
  EXPECT_THAT(check_configuration(machine, "/etc/a.toml"), IsFinding(Verdict::unknown, "cannot be started"));
  answers(0, "");
  EXPECT_THAT(check_configuration(machine, "/etc/a.toml"), IsFinding(Verdict::ok, "/etc/a.toml is right"));
  EXPECT_THAT(asked, ElementsAre("azimuthd", "--check-config", "--config", "/etc/a.toml"));
  answers(0, "right: /etc/a.toml\nwarning: /etc/a.toml: daemon.rig: write it differently\n");
  EXPECT_THAT(check_configuration(machine, "/etc/a.toml"),
              IsFinding(Verdict::warning, "/etc/a.toml: daemon.rig: write it differently"));
  answers(2, "/etc/a.toml:3: unknown key\n");
  const Finding refused = check_configuration(machine, "/etc/a.toml");
  EXPECT_THAT(refused, IsFinding(Verdict::error, "/etc/a.toml:3: unknown key"));
  EXPECT_EQ(refused.fix, "azimuthd --check-config --config /etc/a.toml");
}

TEST_F(SystemChecks, ProgramsAreRunWithTheirArgumentsAsTheyAre) {
  const auto here = this_machine("");
  ASSERT_TRUE(here);
  const auto outcome = here->run({"printf", "%s|", "a b", "it's", "$HOME"});
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->output, "a b|it's|$HOME|");
  EXPECT_EQ(here->run({"sh", "-c", "echo seen >&2; exit 3"})->exit_code, 3);
  EXPECT_EQ(here->run({"sh", "-c", "echo seen >&2; exit 3"})->output, "seen\n");
  EXPECT_FALSE(here->run({"/no/such/program"}));
  EXPECT_FALSE(this_machine("no such user"));
}

}  // namespace
}  // namespace azimuth
