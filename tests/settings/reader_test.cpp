// Each kind of violation with its location. Valid values are set, invalid ones leave the setting unchanged.

#include "settings/reader.hpp"

#include <gmock/gmock.h>
#include <string>

#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ResultOf;
using ::testing::SizeIs;

enum class Colour { red, green };

struct Sample {
  bool flag = false;
  int count = 3;
  double angle_rad = 0.5;
  double gain = 1.0;
  std::string name = "none";
  Colour colour = Colour::red;
  std::optional<double> extra_px;
  std::optional<PixelPoint> centre_px;
};

/// Tables with one member of each kind, in a section and in a nested section.
struct Tables {
  Sample sample;
  Section top{"", "top", {{"name", &sample.name, "a text"}}};
  Section first{"first",
                "first",
                {{"flag", &sample.flag, "a flag"},
                 {"count", &sample.count, "a count", from_to(1, 10)},
                 {"angle_rad", &sample.angle_rad, "an angle", above_to(0, 4)},
                 choice<Colour>("colour", sample.colour, {{"red", Colour::red}, {"green", Colour::green}}, "a word")}};
  Section second{"outer.second",
                 "second",
                 {{"gain", &sample.gain, "a number"},
                  {"extra_px", &sample.extra_px, "optional", from_to(0, 100)},
                  {"centre_px", &sample.centre_px, "a pair", from_to(-10, 10)}}};
  std::vector<Section*> all{&top, &first, &second};

  FileErrors read(std::string_view text) { return read_toml(text, "f.toml", all); }
  FileErrors set(const std::string& assignment) { return apply_override(assignment, all); }
};

auto says(const std::string& part) {
  return ResultOf([](const FileError& v) { return v.text(); }, HasSubstr(part));
}

TEST(Reader, SetsEveryKindOfMember) {
  Tables t;
  const FileErrors violations = t.read(R"(
name = "x"
[first]
flag = true
count = 10
angle_rad = 1
colour = "green"
[outer.second]
gain = -2.5
extra_px = 7
centre_px = [1, -2.5]
)");
  EXPECT_THAT(violations, IsEmpty()) << text(violations);
  EXPECT_EQ(t.sample.name, "x");
  EXPECT_TRUE(t.sample.flag);
  EXPECT_EQ(t.sample.count, 10);
  EXPECT_EQ(t.sample.angle_rad, 1.0);
  EXPECT_EQ(t.sample.colour, Colour::green);
  EXPECT_EQ(t.sample.gain, -2.5);
  EXPECT_EQ(t.sample.extra_px, 7.0);
  EXPECT_EQ(t.sample.centre_px, (PixelPoint{1.0, -2.5}));
}

TEST(Reader, LeavesAbsentKeysAtTheirDefaults) {
  Tables t;
  EXPECT_THAT(t.read(""), IsEmpty());
  EXPECT_EQ(t.sample.count, 3);
  EXPECT_FALSE(t.sample.extra_px);
  EXPECT_FALSE(t.first.find("count")->given);
}

TEST(Reader, ReportsUnknownKeyWithTheNearest) {
  Tables t;
  EXPECT_THAT(t.read("[first]\n  cuont = 2\n"),
              ElementsAre(says("f.toml:2:3: unknown key 'cuont' in [first]; did you mean 'count'?")));
  EXPECT_THAT(t.read("[first]\nzzzzzzzz = 2\n"),
              ElementsAre(ResultOf([](const FileError& v) { return v.message; }, "unknown key 'zzzzzzzz' in [first]")));
}

TEST(Reader, SaysWhereAKeyOfAnotherSectionBelongs) {
  Tables t;
  EXPECT_THAT(t.read("[first]\ngain = 1\n"), ElementsAre(says("it belongs in [outer.second]")));
  EXPECT_THAT(t.read("[first]\nname = 'a'\n"), ElementsAre(says("it belongs at the top of the file")));
}

TEST(Reader, HintsAtTheRightUnitAndConverts) {
  Tables t;
  EXPECT_THAT(t.read("[first]\nangle_deg = 90\n"),
              ElementsAre(says("the key is 'angle_rad', in rad: 90 deg is 1.5708 rad")));
  EXPECT_THAT(t.read("[first]\nangle = 1\n"), ElementsAre(says("the key is 'angle_rad', in rad")));
}

TEST(Reader, ReportsUnknownSections) {
  Tables t;
  EXPECT_THAT(t.read("[fisrt]\ncount = 2\n"), ElementsAre(says("1:2: unknown section [fisrt]; did you mean [first]?")));
  EXPECT_THAT(t.read("[outer]\ngain = 2\n"),
              ElementsAre(says("2:1: unknown key 'gain' in [outer]; it belongs in [outer.second]")));
  EXPECT_THAT(t.read("first = 3\n"), ElementsAre(says("'first' must be a table, not a whole number")));
  EXPECT_THAT(t.read("[[first]]\ncount = 2\n"), ElementsAre(says("'first' must be a table, not an array")));
}

TEST(Reader, ReportsWrongTypes) {
  Tables t;
  const FileErrors violations = t.read(R"(name = 5
[first]
flag = 1
count = 2.0
angle_rad = "wide"
colour = 7
[outer.second]
centre_px = [1, 2, 3]
extra_px = 1979-05-27
)");
  EXPECT_THAT(violations,
              ElementsAre(says("1:1: 'name' must be a text in quotes, not a whole number"),
                          says("3:1: 'first.flag' must be true or false, not a whole number"),
                          says("4:1: 'first.count' must be a whole number, not a number with a fraction"),
                          says("5:1: 'first.angle_rad' must be a number, not a text"),
                          says("6:1: 'first.colour' must be one of \"red\", \"green\", not a whole number"),
                          says("8:1: 'outer.second.centre_px' must be a pair of numbers [a, b], not an array"),
                          says("9:1: 'outer.second.extra_px' must be a number, not a date")));
}

TEST(Reader, ReportsValuesOutOfRangeAndLeavesTheMember) {
  Tables t;
  const FileErrors violations = t.read(R"([first]
count = 11
angle_rad = 0
colour = "blue"
[outer.second]
extra_px = -1
centre_px = [0, 11]
)");
  EXPECT_THAT(violations, ElementsAre(says("'first.count' is 11, must lie in [1, 10]"),
                                      says("'first.angle_rad' is 0, must lie in (0, 4]"),
                                      says("'first.colour' is \"blue\", must be one of \"red\", \"green\""),
                                      says("'outer.second.extra_px' is -1, must lie in [0, 100]"),
                                      says("'outer.second.centre_px' is 11, must lie in [-10, 10]")));
  EXPECT_EQ(t.sample.count, 3);
  EXPECT_EQ(t.sample.angle_rad, 0.5);
  EXPECT_FALSE(t.sample.centre_px);
}

TEST(Reader, RefusesNanAndInfinityEvenWithoutARange) {
  Tables t;
  EXPECT_THAT(t.read("[outer.second]\ngain = nan\n"), ElementsAre(says("must be finite, is nan")));
  EXPECT_THAT(t.read("[outer.second]\ngain = -inf\n"), ElementsAre(says("must be finite, is -inf")));
  EXPECT_THAT(t.read("[outer.second]\ncentre_px = [nan, 1]\n"), ElementsAre(says("must be finite")));
  EXPECT_EQ(t.sample.gain, 1.0);
}

TEST(Reader, ReportsDuplicatesAndGoesOn) {
  Tables t;
  const FileErrors violations = t.read("[first]\ncount = 2\ncount = 4\nflga = true\n[outer.second]\ngain = 'x'\n");
  ASSERT_THAT(violations, SizeIs(3)) << text(violations);
  EXPECT_THAT(violations[0], AllOf(says("f.toml:3:"), says("count")));
  EXPECT_THAT(violations[1], says("f.toml:4:1: unknown key 'flga'"));
  EXPECT_THAT(violations[2], says("f.toml:6:1:"));
}

TEST(Reader, GoesOnAfterABadLine) {
  Tables t;
  const FileErrors violations = t.read("[first]\ncount = = 2\nangle_rad = 9\n[outer.second]\ngain = oops\n");
  ASSERT_THAT(violations, SizeIs(3)) << text(violations);
  EXPECT_THAT(violations[0], says("f.toml:2:"));
  EXPECT_THAT(violations[1], says("f.toml:3:1: 'first.angle_rad' is 9"));
  EXPECT_THAT(violations[2], says("f.toml:5:"));
}

TEST(Reader, DoesNotJudgeKeysBelowABrokenSectionHeader) {
  Tables t;
  EXPECT_THAT(t.read("[first\ncount = 2\n"), ElementsAre(says("f.toml:1:")));
  EXPECT_THAT(t.read("name = \"\"\"never closed\ncount = 2\n"), SizeIs(1));
}

TEST(Reader, PassesOverTablesOfOthers) {
  Tables t;
  static constexpr std::string_view kOthers[] = {"daemon"};
  EXPECT_THAT(read_toml("[daemon.lcm]\nurl = 1\n", "f.toml", t.all, kOthers), IsEmpty());
  EXPECT_THAT(t.read("[daemon.lcm]\nurl = 1\n"), SizeIs(1));
}

TEST(Override, SetsAndReportsLikeTheFile) {
  Tables t;
  EXPECT_THAT(t.set("first.count=7"), IsEmpty());
  EXPECT_THAT(t.set("outer.second.gain = 2.5"), SizeIs(1)) << "spaces are not part of a key";
  EXPECT_THAT(t.set("first.colour=green"), IsEmpty());
  EXPECT_THAT(t.set("name=udpm://239.255.76.67:7667?ttl=0"), IsEmpty());
  EXPECT_EQ(t.sample.count, 7);
  EXPECT_EQ(t.sample.colour, Colour::green);
  EXPECT_EQ(t.sample.name, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_THAT(t.set("name=17"), IsEmpty());
  EXPECT_EQ(t.sample.name, "17");
  EXPECT_THAT(t.set("name=\"quoted\""), IsEmpty());
  EXPECT_EQ(t.sample.name, "quoted");
}

TEST(Override, ReportsWithItsOwnText) {
  Tables t;
  EXPECT_THAT(t.set("first.count=70"), ElementsAre(says("--set first.count=70: 'first.count' is 70, must lie in")));
  EXPECT_THAT(t.set("first.cuont=7"), ElementsAre(says("did you mean 'count'?")));
  EXPECT_THAT(t.set("fisrt.count=7"), ElementsAre(says("did you mean [first]?")));
  EXPECT_THAT(t.set("first.count"), ElementsAre(says("must have the form section.key=value")));
  EXPECT_THAT(t.set("first.count="), ElementsAre(says("must be a whole number, not a text")));
  EXPECT_THAT(t.set("first.count=1\nflag=true"), SizeIs(0)) << "further lines of a value are not keys";
  EXPECT_FALSE(t.sample.flag);
}

TEST(Suggestion, EditDistanceCountsSwapsOnce) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", "abc"), 0U);
  EXPECT_EQ(edit_distance("abcd", "abdc"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(Suggestion, IsOfWhatIsClose) {
  const std::string_view known[] = {"x", "raw", "time", "Heading", "--laps", "count"};
  EXPECT_EQ(nearest("t", known), std::nullopt) << "of one letter every other is as near";
  EXPECT_EQ(nearest("tick", known), std::nullopt) << "half of it is another word";
  EXPECT_EQ(nearest("tmie", known), "time");
  EXPECT_EQ(nearest("heading", known), "Heading");
  EXPECT_EQ(nearest("--lap", known), "--laps");
  EXPECT_EQ(nearest("cuont", known), "count");
  EXPECT_EQ(nearest("nonsense", known), std::nullopt);
}

TEST(Suggestion, OfTwoKeysThatDifferInTheUnitTheOneThatMeasuresTheSame) {
  const std::string_view known[] = {"relocate_beyond_m", "relocate_beyond_rad"};
  EXPECT_EQ(same_but_unit("relocate_beyond_deg", known), "relocate_beyond_rad");
  EXPECT_EQ(same_but_unit("relocate_beyond_mm", known), "relocate_beyond_m");
  EXPECT_EQ(same_but_unit("relocate_beyond", known), "relocate_beyond_m") << "either may be meant";
}

TEST(Suggestion, KnowsCompoundUnits) {
  EXPECT_EQ(unit_of("lambda_drift_rad2_per_m"), "rad2_per_m");
  EXPECT_EQ(unit_of("lambda_distance_m"), "m");
  EXPECT_EQ(unit_of("m"), "");
  EXPECT_EQ(unit_of("best_pair"), "");
  EXPECT_EQ(converted(250.0, "ms", "s"), 0.25);
  EXPECT_EQ(converted(1.0, "ms", "m"), std::nullopt);
}

}  // namespace
}  // namespace azimuth
