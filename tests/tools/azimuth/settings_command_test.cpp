#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

TEST(SettingsCommand, PrintsAConfigurationThatReplays) {
  const ScratchFolder scratch;
  const Outcome outcome = azimuth({"settings"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("max_landmarks"), std::string::npos);
  write_file(scratch / "azimuth.toml", outcome.out);
  const Outcome replayed = azimuth({"replay", test::one_lap(), "--config", scratch / "azimuth.toml"});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
}

TEST(SettingsCommand, SaysWhoHasTheOtherKeys) {
  EXPECT_NE(azimuth({"settings"}).out.find("azimuthd --print-settings"), std::string::npos);
}

TEST(SettingsCommand, PrintsTheKeysOfTheRig) {
  EXPECT_NE(azimuth({"settings", "--rig"}).out.find("sigma_bearing_rad"), std::string::npos);
}

TEST(VersionCommand, PrintsIt) {
  EXPECT_THAT(azimuth({"version"}).out, testing::MatchesRegex("azimuth [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_EQ(azimuth({"--version"}).out, azimuth({"version"}).out);
}

TEST(CommandLine, NeedsASubcommand) {
  EXPECT_EQ(azimuth({}).code, 2);
  EXPECT_EQ(azimuth({"fly"}).code, 2);
  EXPECT_EQ(azimuth({"--help"}).code, 0);
  EXPECT_EQ(azimuth({"replay", "--help"}).code, 0);
}

}  // namespace
}  // namespace azimuth::test
