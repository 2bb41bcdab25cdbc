// Texts that would overflow the TOML library's stack or take it very long are refused before parsing; realistic texts
// are not.

#include <gmock/gmock.h>
#include <string>

#include "settings/configuration.hpp"
#include "settings/file_text.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kManyLevels = 200'000;

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

/// The reason for which a configuration with this text is refused.
std::string refusal(const std::string& toml) {
  const FileResult<Configuration> read = read_configuration(toml, "azimuth.toml");
  return read ? "" : text(read.error());
}

struct Deep {
  const char* name;
  std::string toml;
  int line;
};
std::ostream& operator<<(std::ostream& out, const Deep& deep) { return out << deep.name; }

class DeepToml : public ::testing::TestWithParam<Deep> {};

TEST_P(DeepToml, IsRefusedWithItsLine) {
  const std::string said = "azimuth.toml:" + std::to_string(GetParam().line) + ": is deeper than 32 levels";
  EXPECT_THAT(refusal(GetParam().toml), HasSubstr(said));
  const FileResult<Rig> rig = read_rig(GetParam().toml, "azimuth.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.error()), HasSubstr(said));
}

INSTANTIATE_TEST_SUITE_P(
    All, DeepToml,
    ::testing::Values(Deep{"dotted_key", times(kManyLevels, "a.") + "a = 1\n", 1},
                      Deep{"spaced_key", "\n" + times(kManyLevels, "a . ") + "a = 1\n", 2},
                      Deep{"quoted_key", times(kManyLevels / 4, "\"=,#[\".'x'.") + "a = 1\n", 1},
                      Deep{"header", "# one\n[" + times(kManyLevels, "a.") + "a]\n", 2},
                      Deep{"header_of_list", "[[" + times(kManyLevels, "a.") + "a]]\n", 1},
                      Deep{"lists", "a = " + times(kManyLevels, "[") + times(kManyLevels, "]"), 1},
                      Deep{"lists_over_lines", "a = [\n" + times(40, "[\n") + times(41, "]\n"), 33},
                      Deep{"tables", "a = " + times(kManyLevels / 2, "{a=") + "1" + times(kManyLevels / 2, "}"), 1},
                      Deep{"key_in_table", "a = { " + times(kManyLevels, "b.") + "b = 1 }\n", 1},
                      Deep{"after_long_text", "a = \"\"\"\n\\\"\"\" \"\"\"\"\"\n" + times(40, "b.") + "b = 1\n", 3},
                      Deep{"after_literal_text", "a = '''\n''\\'''\n" + times(40, "b.") + "b = 1\n", 3},
                      Deep{"after_a_mistake", "a = \"open\n" + times(40, "b.") + "b = 1\n", 2}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(TomlBounds, WhatIsNoKeyMayHaveAnyDotsAndBrackets) {
  const std::string dots = times(1000, "a.") + times(100, "[{");
  const std::string read =
      refusal("# " + dots + "\nx = \"" + dots + "\"\ny = '''\n" + dots + "\n'''\nz = [" + times(1000, "0.5, ") + "]\n");
  EXPECT_THAT(read, Not(HasSubstr("deeper")));
  EXPECT_THAT(read, HasSubstr("unknown key 'x'"));  // proves that the text was parsed
}

TEST(TomlBounds, ThirtyTwoLevelsAreRead) {
  EXPECT_THAT(refusal(times(31, "a.") + "a = 1\n"), HasSubstr("unknown section"));
  EXPECT_THAT(refusal(times(32, "a.") + "a = 1\n"), HasSubstr("deeper"));
}

TEST(TomlBounds, ATextLargerThanAnySettingsIsRefused) {
  EXPECT_THAT(refusal("#" + std::string(kLargestSettings, 'x')), HasSubstr("is larger than 1024 kB"));
}

TEST(TomlBounds, OverridesAreHeldToThemToo) {
  const std::string overrides[] = {"ekf.initialisation=" + times(kManyLevels, "[")};
  EXPECT_FALSE(read_configuration("", "", overrides));
}

TEST(TomlBounds, MistakesBeyondTheHundredthAreNotLookedFor) {
  std::string many;
  for (int i = 0; i < 20'000; ++i) many += "initialisatiom_" + std::to_string(i) + " = 1\n";
  const FileResult<Configuration> read = read_configuration(many, "azimuth.toml");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().size(), 101);
  EXPECT_THAT(read.error().back().text(), HasSubstr("perhaps more"));
}

TEST(FileText, ADeviceWithoutEndIsRefused) {
  const FileResult<std::string> read = file_text("/dev/zero");
  ASSERT_FALSE(read);
  EXPECT_THAT(text(read.error()), HasSubstr("/dev/zero: cannot be read: is larger than 16 MB"));
}

}  // namespace
}  // namespace azimuth
