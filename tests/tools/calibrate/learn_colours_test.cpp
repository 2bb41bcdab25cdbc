#include "tools/calibrate/learn_colours.hpp"

#include <gmock/gmock.h>

#include "tests/perception/colour/colour_images.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const FrameFormat kColourFormat = packed_format(PixelFormat::rgb8, 100, 80);

/// A patch of one colour with shading and noise, as painted surfaces have in images.
std::vector<Rgb> patch(Rgb colour, double darkest, unsigned seed) {
  test::Canvas canvas(20, 20, colour);
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 20; ++u) canvas.at(u, v) = test::mixed({}, colour, darkest + (1.0 - darkest) * u / 19.0);
  std::mt19937 random(seed);
  add_noise(canvas, 3.0, random);
  return canvas.pixels;
}

bool belongs(const ColourClass& colours, Rgb colour) { return fits(colours, hsv_of(colour)); }

TEST(LearnColours, AClassHoldsItsColourInHalfTheLightAndNoOther) {
  const std::array colours{test::kRed, test::kYellow, test::kGreen, test::kBlue};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const auto learnt = learn_class({"this", patch(colours[i], 0.7, 1)});
    ASSERT_TRUE(learnt);
    EXPECT_EQ(learnt->name, "this");
    for (std::size_t k = 0; k < colours.size(); ++k) {
      EXPECT_EQ(belongs(*learnt, colours[k]), i == k);
      EXPECT_EQ(belongs(*learnt, test::mixed({}, colours[k], 0.5)), i == k);
    }
    EXPECT_FALSE(belongs(*learnt, test::kGrey));
    EXPECT_FALSE(belongs(*learnt, test::mixed(test::kGrey, colours[i], 0.3))) << "hardly coloured";
  }
}

TEST(LearnColours, HuesMayLieOnBothSidesOfZero) {
  std::vector<Rgb> pixels = patch({200, 20, 40}, 0.9, 2);
  for (const Rgb& pixel : patch({200, 40, 20}, 0.9, 3)) pixels.push_back(pixel);
  const auto learnt = learn_class({"red", pixels});
  ASSERT_TRUE(learnt);
  EXPECT_GT(learnt->hue_from_deg, 330.0);
  EXPECT_LT(learnt->hue_to_deg, 30.0);
}

TEST(LearnColours, OddPixelsDoNotCount) {
  std::vector<Rgb> pixels = patch(test::kGreen, 0.9, 4);
  const auto without = learn_class({"green", pixels});
  for (int i = 0; i < 6; ++i) pixels.push_back(i % 2 == 0 ? Rgb{250, 250, 250} : test::kRed);  // highlights, dirt
  const auto with = learn_class({"green", pixels});
  ASSERT_TRUE(with && without);
  EXPECT_NEAR(with->hue_from_deg, without->hue_from_deg, 3.0);
  EXPECT_NEAR(with->hue_to_deg, without->hue_to_deg, 3.0);
  EXPECT_NEAR(with->saturation_min, without->saturation_min, 0.05);
}

TEST(LearnColours, GreysAndNextToNothingTeachNothing) {
  EXPECT_FALSE(learn_class({"grey", patch(test::kGrey, 0.5, 5)}));
  EXPECT_FALSE(learn_class({"black", patch({4, 3, 2}, 0.5, 6)}));
  EXPECT_FALSE(learn_class({"none", {}}));
  EXPECT_FALSE(learn_class({"few", {test::kRed, test::kRed}}));
}

TEST(LearnColours, RectanglesAndPointsMustLieInTheImage) {
  const auto corners = [](const std::optional<PixelRectangle>& r) {
    return r ? std::vector{r->first_u, r->first_v, r->last_u, r->last_v} : std::vector<int>{};
  };
  EXPECT_THAT(corners(parse_rectangle("5,6,20,30", kColourFormat)), ElementsAre(5, 6, 20, 30));
  EXPECT_THAT(corners(parse_rectangle("20,6,5,30", kColourFormat)), ElementsAre(5, 6, 20, 30)) << "any two corners";
  EXPECT_THAT(corners(parse_click("50,40", kColourFormat)), ElementsAre(47, 37, 53, 43));
  EXPECT_THAT(corners(parse_click("0,79", kColourFormat)), ElementsAre(0, 76, 3, 79));
  for (const char* bad : {"", "1,2,3", "1,2,3,4,5", "1,2,3,x", "1 2 3 4", "-1,2,3,4", "1,2,100,4", "1,2,3,80",
                          "1,2,3,4,", "99999999999,2,3,4"})
    EXPECT_FALSE(parse_rectangle(bad, kColourFormat)) << bad;
  for (const char* bad : {"", "1", "1,2,3", "100,1", "1,80", "-1,1"})
    EXPECT_FALSE(parse_click(bad, kColourFormat)) << bad;
}

TEST(LearnColours, PixelsAreTakenFromTheRectangle) {
  test::Canvas canvas(100, 80);
  canvas.at(7, 9) = test::kRed;
  canvas.at(8, 9) = test::kBlue;
  const test::Frame frame = test::taken(canvas, PixelFormat::rgb8, 5);
  std::vector<Rgb> pixels;
  add_pixels(frame.view(), {6, 9, 8, 9}, pixels);
  EXPECT_THAT(pixels, ElementsAre(test::kGrey, test::kRed, test::kBlue));
}

TEST(LearnColours, ReplaceClassesOfTheirNameInTheirPlace) {
  const std::vector<ColourClass> classes = ColourSettings{}.classes;
  const std::vector<ColourClass> learnt{{.name = "pink", .hue_from_deg = 300}, {.name = "yellow", .hue_from_deg = 41}};
  const std::vector<ColourClass> all = updated(classes, learnt);
  EXPECT_THAT(all, ElementsAre(classes[0], learnt[1], classes[2], classes[3], learnt[0]));
}

TEST(LearnColours, TellHowWellTheySeparate) {
  const std::vector<LabelledPixels> labelled{{"red", {test::kRed, test::kRed, test::kYellow, test::kGrey}}};
  EXPECT_THAT(separation_text(labelled, ColourSettings{}.classes),
              HasSubstr("# red: 4 pixels, 50.0 % its own class, 25.0 % another, 25.0 % none"));
}

}  // namespace
}  // namespace azimuth
