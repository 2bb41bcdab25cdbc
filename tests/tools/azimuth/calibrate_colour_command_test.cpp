#include <gmock/gmock.h>

#include "settings/configuration.hpp"
#include "tests/perception/colour/colour_images.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Red on the left, blue on the right, grey between.
std::string ppm() {
  Canvas canvas(90, 40);
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 90; ++u)
      if (u < 30 || u >= 60) canvas.at(u, v) = u < 30 ? kRed : kBlue;
  std::mt19937 random(1);
  add_noise(canvas, 3.0, random);
  const auto frame = taken(canvas, PixelFormat::rgb8);
  return "P6\n90 40\n255\n" + std::string(reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size());
}

class CalibrateColour : public testing::Test {
 protected:
  CalibrateColour() { write_file(image_, ppm()); }

  test::Outcome calibrate(std::vector<std::string> options) const {
    options.insert(options.begin(), {"calibrate", "colour", image_});
    return azimuth(options);
  }
  static std::vector<ColourClass> classes_of(const std::string& text) {
    const auto read = read_configuration(text, "printed");
    EXPECT_TRUE(read) << azimuth::text(read.error());
    return read ? read->perception.colour.classes : std::vector<ColourClass>{};
  }
  ScratchFolder scratch_;
  std::string image_ = scratch_ / "image.ppm";
};

TEST_F(CalibrateColour, PrintsClassesThatTheConfigurationReads) {
  const test::Outcome outcome =
      calibrate({"--class", "warm", "--rectangle", "2,2,25,35", "--click", "10,10", "--class", "cold", "--click",
                 "70,20", "--class", "warm", "--click", "20,20", "--class", "cold", "--click", "80,10"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<ColourClass> classes = classes_of(outcome.out);
  ASSERT_THAT(classes, SizeIs(2));
  EXPECT_EQ(classes[0].name, "warm");
  EXPECT_TRUE(fits(classes[0], hsv_of(kRed)));
  EXPECT_FALSE(fits(classes[0], hsv_of(kBlue)));
  EXPECT_EQ(classes[1].name, "cold");
  EXPECT_TRUE(fits(classes[1], hsv_of(kBlue)));
  EXPECT_THAT(outcome.out, HasSubstr("# cold: 98 pixels, 100.0 % its own class"));
}

TEST_F(CalibrateColour, KeepsTheOtherClassesOfAConfiguration) {
  const std::string config = scratch_ / "azimuth.toml", out = scratch_ / "classes.toml";
  write_file(config, "[[colour.class]]\nname = \"blue\"\n[[colour.class]]\nname = \"green\"\nhue_from_deg = 111\n");
  const test::Outcome outcome =
      calibrate({"--rectangle", "65,5,85,35", "--class", "blue", "--config", config, "--out", out});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<ColourClass> classes = classes_of(file_bytes(out));
  ASSERT_THAT(classes, SizeIs(2));
  EXPECT_EQ(classes[0].name, "blue");
  EXPECT_GT(classes[0].hue_from_deg, 200.0);
  EXPECT_EQ(classes[1], (ColourClass{.name = "green", .hue_from_deg = 111}));
}

TEST_F(CalibrateColour, RefusesWhatTeachesNothing) {
  EXPECT_EQ(calibrate({"--rectangle", "2,2,25,35"}).code, 2) << "a colour needs a name";
  EXPECT_THAT(calibrate({"--class", "red"}).err, HasSubstr("class \"red\": too few of its 0 pixels"));
  EXPECT_THAT(calibrate({"--class", "grey", "--rectangle", "35,5,55,35"}).err, HasSubstr("have a hue"));
  EXPECT_THAT(calibrate({"--class", "red", "--rectangle", "2,2,25,40"}).err,
              HasSubstr("'2,2,25,40' is not a rectangle U0,V0,U1,V1 within the image"));
  write_file(image_, "P5\n2 2\n255\nabcd");
  EXPECT_THAT(calibrate({"--class", "red", "--click", "1,1"}).err, HasSubstr("has no colours"));
  write_file(image_, "none");
  EXPECT_EQ(calibrate({"--class", "red", "--click", "1,1"}).code, 2);
}

}  // namespace
}  // namespace azimuth::test
