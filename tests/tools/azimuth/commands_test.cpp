// The command line as a whole: the version, old names, and what is wrong with words that nobody knows.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

TEST(CommandLine, PrintsItsVersion) {
  EXPECT_THAT(azimuth({"--version"}).out, testing::MatchesRegex("azimuth [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, NeedsASubcommand) {
  EXPECT_EQ(azimuth({}).code, 2);
  EXPECT_EQ(azimuth({"fly"}).code, 2);
  EXPECT_EQ(azimuth({"--help"}).code, 0);
  EXPECT_EQ(azimuth({"replay", "--help"}).code, 0);
}

TEST(CommandLine, AnswersACommandOfAnEarlierVersionWithTheNewOne) {
  const std::pair<const char*, const char*> names[] = {
      {"compare", "azimuth report compare"},    {"evaluate", "azimuth report trajectory"},
      {"log", "azimuth report logs"},           {"refine", "azimuth map refine"},
      {"convert", "azimuth import LOG RUN"},    {"version", "azimuth --version"},
      {"settings", "azimuthd --print-settings"}};
  for (const auto& [old, now] : names) {
    const Outcome outcome = azimuth({old, "lab"});
    EXPECT_EQ(outcome.code, 2) << old;
    EXPECT_THAT(outcome.err, HasSubstr(now));
    EXPECT_THAT(azimuth({"--help"}).out, testing::Not(HasSubstr("\n  " + std::string(old) + " ")));
  }
}

}  // namespace
}  // namespace azimuth::test
