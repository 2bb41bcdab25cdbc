// Lists of tables, mainly [[colour.class]].

#include <gmock/gmock.h>

#include "settings/colour_section.hpp"
#include "settings/configuration.hpp"

namespace azimuth {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string violations_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const FileResult<Configuration> read = read_configuration(text, "a.toml", overrides);
  return read ? "" : azimuth::text(read.error());
}

ColourSettings colour_of(const std::string& text) {
  const FileResult<Configuration> read = read_configuration(text, "a.toml");
  EXPECT_TRUE(read) << azimuth::text(read.error());
  return read ? read->perception.colour : ColourSettings{};
}

const std::string kTwo =
    "[[colour.class]]\nname = \"orange\"\nhue_from_deg = 15\nhue_to_deg = 35.25\n"
    "[[colour.class]]\nname = \"pink\"\nsaturation_max = 0.6\nvalue_min = 0.5\n";

TEST(ColourClasses, OfAFileReplaceThoseThereWere) {
  const ColourSettings colour = colour_of(kTwo);
  EXPECT_THAT(colour.classes, ElementsAre(ColourClass{.name = "orange", .hue_from_deg = 15, .hue_to_deg = 35.25},
                                          ColourClass{.name = "pink", .saturation_max = 0.6, .value_min = 0.5}));
  EXPECT_EQ(colour_of("").classes, ColourSettings{}.classes);
}

TEST(ColourClasses, ReadBackAsTheyAreWritten) {
  Configuration configuration;
  configuration.perception.colour = colour_of(kTwo);
  EXPECT_EQ(colour_of(configuration_text(configuration)), configuration.perception.colour);
  EXPECT_EQ(colour_of(configuration_text({})), ColourSettings{});
  EXPECT_EQ(colour_of(colour_classes_text(configuration.perception.colour.classes)).classes,
            configuration.perception.colour.classes);
}

TEST(ColourClasses, AreReportedWithTheirPlaces) {
  EXPECT_THAT(violations_of("[[colour.class]]\nname = \"a\"\nhue_form_deg = 3\n"),
              HasSubstr("a.toml:3:1: unknown key 'hue_form_deg' in [[colour.class]]; did you mean 'hue_from_deg'?"));
  EXPECT_THAT(violations_of("[[colour.class]]\nname = \"a\"\n[[colour.class]]\nname = \"b\"\nvalue_min = 2\n"),
              HasSubstr("a.toml:5:1: 'colour.class.value_min' is 2, must lie in [0, 1]"));
  EXPECT_THAT(violations_of("[[colour.class]]\nname = \"a\"\nname = \"b\"\n"), HasSubstr("a.toml:3:"));
  EXPECT_THAT(violations_of("[colour]\nhue_from_deg = 3\n"), HasSubstr("it belongs in [[colour.class]]"));
  EXPECT_THAT(violations_of("[[colour.clas]]\nname = \"a\"\n"), HasSubstr("a.toml:1:"));
  EXPECT_THAT(violations_of("[[ekf]]\nthinning_s = 3\n"), HasSubstr("'ekf' must be a table, not an array"));
}

TEST(ColourClasses, MustMakeSense) {
  EXPECT_THAT(violations_of("\n[[colour.class]]\nhue_to_deg = 3\n"),
              HasSubstr("a.toml:2:1: [[colour.class]] needs the key 'name'"));
  EXPECT_THAT(violations_of("[[colour.class]]\nname = \"a\"\n[[colour.class]]\nname = \"a\"\n"),
              HasSubstr("a.toml:3:1: [[colour.class]] \"a\" is there twice"));
  EXPECT_THAT(violations_of("[[colour.class]]\nname = \"a\"\nvalue_min = 0.9\nvalue_max = 0.2\n"),
              HasSubstr("\"a\" holds no colour"));
  std::string many;
  for (std::size_t i = 0; i < kMostColourClasses; ++i)
    many += "[[colour.class]]\nname = \"" + std::to_string(i) + "\"\n";
  EXPECT_THAT(violations_of(many), IsEmpty());
  EXPECT_THAT(violations_of(many + "[[colour.class]]\nname = \"more\"\n"), HasSubstr("is one too many"));
}

TEST(ColourClasses, AreListsOfTablesAndNothingElse) {
  const std::string wants = "'colour.class' must be tables headed [[colour.class]], not ";
  EXPECT_THAT(violations_of("[colour.class]\nname = \"a\"\n"), HasSubstr(wants + "a table"));
  EXPECT_THAT(violations_of("[colour]\nclass = []\n"), HasSubstr(wants + "an array"));
  EXPECT_THAT(violations_of("[colour]\nclass = [1, {name = \"a\"}]\n"), HasSubstr(wants + "an array"));
  EXPECT_THAT(violations_of("[colour]\nclass = 3\n"), HasSubstr(wants + "a whole number"));
  EXPECT_THAT(violations_of("", {"colour.class.name=a"}), HasSubstr("is a list, which only a file can give"));
}

TEST(ColourClasses, DefaultsLieInTheirRanges) {
  ColourSettings colour;
  const Section section = colour_section(colour);
  const Elements& classes = *section.elements;
  ASSERT_EQ(classes.count(), 4U);
  for (std::size_t i = 0; i < classes.count(); ++i) {
    for (const Key& key : classes.keys(i)) EXPECT_TRUE(key.in_range()) << key.name;
    EXPECT_EQ(classes.problem(i), std::nullopt);
  }
}

}  // namespace
}  // namespace azimuth
