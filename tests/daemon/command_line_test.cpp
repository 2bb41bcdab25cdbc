// azimuthd at the command line: its output and its exit codes.

#include <gmock/gmock.h>

#include "daemon/config/daemon_settings.hpp"
#include "settings/configuration.hpp"
#include "tests/daemon/child_process.hpp"
#include "tests/daemon/run_files.hpp"
#include "tests/support/places.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct Ended {
  int exit_code = -1;
  std::string output, error;
};

class CommandLine : public ::testing::Test {
 protected:
  Ended run(std::vector<std::string> arguments, const std::string& program = AZIMUTHD) {
    arguments.insert(arguments.begin(), program);
    test::ChildProcess daemon(arguments, folder_.path());
    const std::optional<int> exit_code = daemon.wait(60s);
    return {exit_code.value_or(-1), daemon.standard_output(), daemon.standard_error()};
  }

  std::string path(const std::string& name) const { return folder_.path() / name; }

  test::TemporaryFolder folder_;
};

TEST_F(CommandLine, WithoutASourceItSaysHowToGiveOne) {
  const Ended outcome = run({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("--play RUN"));
}

TEST_F(CommandLine, RefusesUnknownOptions) { EXPECT_EQ(run({"--bogus"}).exit_code, 2); }

TEST_F(CommandLine, PrintsVersionAndHelp) {
  const Ended version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.output, StartsWith("azimuthd "));
  EXPECT_THAT(run({"--help"}).output, AllOf(HasSubstr("--play"), HasSubstr("--check-config"), HasSubstr("--set")));
}

TEST_F(CommandLine, ReportsEveryViolationOfFileAndOptionsAtOnce) {
  test::write_text(path("bad.toml"), "[ekf]\ngate_chi = 1\n[daemon.play]\nspeed = \"fast\"\n[daemon.lmc]\n");
  const Ended outcome = run({"--config", path("bad.toml"), "--set", "stage.wait_for_odometry_ms=5", "--speed", "-1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("bad.toml:2:1: unknown key 'gate_chi' in [ekf]"));
  EXPECT_THAT(outcome.error, HasSubstr("bad.toml:4:1: 'daemon.play.speed' must be a number"));
  EXPECT_THAT(outcome.error, HasSubstr("bad.toml:5:9: unknown section [daemon.lmc]; did you mean [daemon.lcm]?"));
  EXPECT_THAT(outcome.error, HasSubstr("the key is 'wait_for_odometry_s', in s"));
  EXPECT_THAT(outcome.error, HasSubstr("'daemon.play.speed' is -1, must lie in"));
}

TEST_F(CommandLine, ChecksTheConfigurationWithoutRunning) {
  EXPECT_EQ(run({"--check-config", "--config", test::source_folder() / "config/azimuth.toml"}).exit_code, 0);
  const Ended missing = run({"--check-config", "--config", path("none.toml")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.error, HasSubstr("none.toml: cannot be read: No such file"));
  EXPECT_EQ(run({"--check-config", "--lcm-url", "carrier-pigeon://"}).exit_code, 2);
}

TEST_F(CommandLine, SaysWhatItHasChecked) {
  const Ended nothing = run({"--check-config"});
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_EQ(
      nothing.output,
      "right: the default settings (no --config FILE is given); it names neither recording nor odometer, so no rig "
      "was checked\n");
  const std::string file = test::source_folder() / "config/azimuth.toml";
  EXPECT_THAT(run({"--check-config", "--config", file}).output, StartsWith("right: " + file + "; it names neither"));
  const std::string run_folder = test::write_run(test::small_recording(2.0), path("run"));
  const Ended all = run({"--check-config", "--config", file, "--play", run_folder});
  EXPECT_THAT(all.output, StartsWith("right: " + file + " and " + run_folder + "/rig.toml; playing " + run_folder));
  EXPECT_EQ(all.error, "");
}

/// A robot's configuration that names its rig and its DBC file by relative paths.
class RelativePaths : public CommandLine {
 protected:
  void SetUp() override {
    fs::create_directory(path("here"));
    fs::create_directory(path("there"));
    test::write_text(path("there/robot.toml"),
                     "[daemon]\nrig = \"rig.toml\"\n[daemon.live]\nodometer = \"can\"\n[daemon.can]\ndbc = "
                     "\"base.dbc\"\nodometry = \"ticks\"\nleft = \"Wheels.LeftTicks\"\nright = "
                     "\"Wheels.RightTicks\"\nticks_per_m = 20000\ntrack_m = 0.36\n");
  }
  void put(const std::string& folder) {
    const fs::path source = test::source_folder() / "config";
    fs::copy(source / "rigs/colour-mirror.toml", path(folder) + "/rig.toml");
    fs::copy(source / "simulated-can.dbc", path(folder) + "/base.dbc");
  }
  Ended check_in(const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"-c",       "cd \"$0\" && exec \"$@\"", path(folder), AZIMUTHD, "--check-config",
                                   "--config", "../there/robot.toml"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, "sh");
  }
};

TEST_F(RelativePaths, BeginAtTheConfigurationsFolder) {
  put("there");
  for (const char* const folder : {"here", "there"}) {
    const Ended ended = check_in(folder);
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_THAT(ended.output, Not(HasSubstr("warning")));
  }
}

TEST_F(RelativePaths, ThatAreInTheWorkingDirectoryOnlyAreStillFoundAndWarnedOf) {
  put("here");
  const Ended here = check_in("here");
  EXPECT_EQ(here.exit_code, 0) << here.error;
  EXPECT_THAT(here.output, HasSubstr("warning: ../there/robot.toml: daemon.rig \"rig.toml\" is not in"));
  EXPECT_THAT(here.output, HasSubstr("daemon.can.dbc \"base.dbc\" is not in"));
  const Ended there = check_in("there");
  EXPECT_EQ(there.exit_code, 2);
  EXPECT_THAT(there.error, HasSubstr("cannot be read: No such file"));
}

TEST_F(RelativePaths, OfTheCommandLineBeginInTheWorkingDirectory) {
  put("here");
  EXPECT_EQ(check_in("there", {"--rig", "../here/rig.toml", "--set", "daemon.can.dbc=../here/base.dbc"}).exit_code, 0);
  EXPECT_EQ(check_in("here", {"--rig", "rig.toml", "--set", "daemon.can.dbc=base.dbc"}).exit_code, 0);
}

TEST_F(CommandLine, RefusesARunWithoutReadableTablesOrRig) {
  EXPECT_EQ(run({"--play", path("none")}).exit_code, 2);
  const auto run_folder = test::write_run(test::small_recording(2.0), path("run"));
  EXPECT_EQ(run({"--check-config", "--play", run_folder}).exit_code, 0);
  test::write_text(run_folder / "rig.toml", "[camera]\nsigma_bearing_deg = 2.5\n");
  const Ended outcome = run({"--play", run_folder});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("rig.toml:2:1: unknown key 'sigma_bearing_deg' in [camera]; the key is "
                                       "'sigma_bearing_rad', in rad"));
}

TEST_F(CommandLine, ShippedConfigurationIsTheReference) {
  const Ended outcome = run({"--print-settings"});
  EXPECT_EQ(outcome.exit_code, 0);
  std::ifstream shipped(test::source_folder() / "config/azimuth.toml");
  const std::string text{std::istreambuf_iterator<char>(shipped), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text, outcome.output) << "write it anew: azimuthd --print-settings > config/azimuth.toml";
}

TEST_F(CommandLine, PrintsTheSettingsOfTheRig) {
  const Ended outcome = run({"--print-rig-settings"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("#sigma_bearing_rad = "));
}

TEST_F(CommandLine, EveryDefaultOfTheReferenceIsValid) {
  std::string text = run({"--print-settings"}).output, all_keys;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool at_key = text[i] == '#' && (i == 0 || text[i - 1] == '\n') && i + 1 < text.size() && text[i + 1] != ' ';
    if (!at_key) all_keys += text[i];
  }
  test::write_text(path("all.toml"), all_keys);
  const Ended outcome = run({"--check-config", "--config", path("all.toml")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
}

TEST(DaemonSettings, TextsThatMeanNothingToAnyIidcCameraAreNamed) {
  DaemonSettings settings;
  settings.live.iidc.shutter = "4 ms";
  EXPECT_TRUE(check(settings).empty());
  settings.live.iidc.shutter = "4 miles";
  const FileErrors violations = check(settings);
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].file, "daemon.iidc.shutter");
  EXPECT_THAT(violations[0].message, StartsWith("is \"4 miles\", must be"));
}

TEST(DaemonSettings, DefaultsLieInTheirRanges) {
  DaemonSettings settings;
  for (const Section& section : daemon_sections(settings)) {
    for (const Key& key : section.keys) {
      EXPECT_TRUE(key.in_range()) << key.name;
      EXPECT_FALSE(key.help.empty()) << key.name;
    }
  }
  EXPECT_TRUE(check(settings).empty());
}

}  // namespace
}  // namespace azimuth
