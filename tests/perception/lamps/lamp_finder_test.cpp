#include "slam/perception/lamps/lamp_finder.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/perception/lamps/gray_pictures.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

std::vector<LampBlob> found_in(const test::GrayPicture& picture, const VisibleRows& visible,
                               const LampSettings& settings = {}) {
  LampFinder finder(settings);
  std::vector<LampBlob> out;
  finder.find(picture.view(), visible, out);
  return out;
}
std::vector<LampBlob> found_in(const test::GrayPicture& picture, const LampSettings& settings = {}) {
  return found_in(picture, picture.all_visible(), settings);
}

void add_noise(test::GrayPicture& picture, double sigma, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  for (std::uint8_t& pixel : picture.pixels)
    pixel = static_cast<std::uint8_t>(std::lround(std::clamp(pixel + noise(engine), 0.0, 255.0)));
}

test::GrayPicture three_lamps(double background, double light) {
  test::GrayPicture picture(200, 160, static_cast<std::uint8_t>(background));
  picture.rectangle(50.2, 40.7, 20, 6, 0.4, light);
  picture.rectangle(120.9, 90.1, 9, 8, 0.0, light);
  picture.rectangle(160.5, 30.5, 14, 3, 1.9, light);
  return picture;
}

TEST(LampFinder, FindsLampsInAnyLight) {
  for (const double background : {0.0, 12.0, 60.0}) {
    for (const double light : {background + 60.0, 140.0, 255.0}) {
      test::GrayPicture picture = three_lamps(background, light);
      add_noise(picture, 3.0, 1);
      const std::vector<LampBlob> lamps = found_in(picture);
      ASSERT_EQ(lamps.size(), 3U) << background << " to " << light;
      EXPECT_LT((lamps[1].centroid - Pixel(50.2, 40.7)).norm(), 0.15);
    }
  }
}

TEST(LampFinder, FindsNothingInNoise) {
  for (const double sigma : {0.0, 2.0, 5.0, 12.0}) {
    test::GrayPicture picture(300, 300, 60);
    add_noise(picture, sigma, 3);
    EXPECT_TRUE(found_in(picture).empty()) << sigma;
  }
}

TEST(LampFinder, LeavesOutWhatIsLit) {
  test::GrayPicture picture = three_lamps(5, 250);
  picture.rectangle(100, 130, 12, 9, 0, 160);
  EXPECT_EQ(found_in(picture).size(), 3U);
  LampSettings settings;
  settings.min_peak_share = 0.0;
  EXPECT_EQ(found_in(picture, settings).size(), 4U) << "else it would not have been its light that told it";
}

TEST(LampFinder, LeavesOutWhatIsCut) {
  for (const auto& [u, v] : {std::pair{0, 80}, {199, 80}, {100, 0}, {100, 159}}) {
    test::GrayPicture picture = three_lamps(5, 250);
    picture.rectangle(u, v, 12, 12, 0, 250);
    EXPECT_EQ(found_in(picture).size(), 3U);
  }
  // A strut across the second lamp, above, below or beside its centre.
  for (const auto& [du, dv] : {std::pair{0, 5}, {0, -5}, {5, 0}, {-5, 0}}) {
    const test::GrayPicture picture = three_lamps(5, 250);
    std::vector<std::uint8_t> visible(picture.pixels.size(), 255);
    for (int v = 88 + dv; v <= 92 + dv; ++v)
      for (int u = 119 + du; u <= 123 + du; ++u) visible[static_cast<std::size_t>(v * 200 + u)] = 0;
    EXPECT_EQ(found_in(picture, {visible, 200, 160}).size(), 2U);
  }
}

/// Only parts of a lamp thinner than a pixel exceed the threshold, and no such part is at the lamp's middle.
TEST(LampFinder, TakesNoPieceOfAThinLampForALamp) {
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    test::GrayPicture picture = three_lamps(5, 250);
    const double turn_rad = 0.01 + 0.004 * k, width_px = 0.8 + 0.01 * k;
    picture.rectangle(100.2, 130.3, 24.0, width_px, turn_rad, 250);
    for (const LampBlob& blob : found_in(picture)) {
      if (std::abs(blob.centroid.y() - 130.3) > 8.0) continue;
      ++seen;
      EXPECT_NEAR(blob.centroid.x(), 100.2, 2.5) << width_px << " px, slanted by " << turn_rad;
    }
  }
  EXPECT_GT(seen, 15) << "those that are seen whole are lamps";
}

TEST(LampFinder, PartsLampsThatTheirHaloJoins) {
  test::GrayPicture picture(200, 160, 5);
  picture.rectangle(100, 80, 60, 4, 0.2, 150);  // the halo
  picture.rectangle(100 - 24.5, 80 - 5, 16, 9, 0.2, 255);
  picture.rectangle(100 + 24.5, 80 + 5, 16, 9, 0.2, 255);
  const std::vector<LampBlob> lamps = found_in(picture);
  ASSERT_EQ(lamps.size(), 2U);
  EXPECT_NEAR(lamps[0].centroid.x(), 75.5, 1.0);
  EXPECT_NEAR(lamps[1].centroid.x(), 124.5, 1.0);

  picture.rectangle(100, 80, 60, 2, 0.2, 255);
  EXPECT_TRUE(found_in(picture).empty()) << "what cannot be parted has no place";
}

TEST(LampFinder, ThresholdStandsStillWhileTheLightFlickers) {
  LampFinder finder({});
  std::vector<LampBlob> out;
  std::vector<int> thresholds;
  for (const double light : {200.0, 204.0, 197.0, 208.0, 199.0}) {
    const test::GrayPicture picture = three_lamps(5, light);
    finder.find(picture.view(), picture.all_visible(), out);
    EXPECT_EQ(finder.light().threshold, thresholds.empty() ? finder.light().threshold : thresholds.front());
    thresholds.push_back(finder.light().threshold);
  }
  const test::GrayPicture dim = three_lamps(5, 100);
  finder.find(dim.view(), dim.all_visible(), out);
  EXPECT_LT(finder.light().threshold, 70) << "but follows the exposure";
  EXPECT_EQ(out.size(), 3U);
}

TEST(LampFinder, SurvivesAnyImageWithoutAllocating) {
  LampFinder finder({});
  std::vector<LampBlob> out;
  out.reserve(LampFinder::kMostRuns);
  test::GrayPicture checks(700, 700), noise(700, 700), white(700, 700, 255);
  for (int v = 0; v < 700; ++v)
    for (int u = 0; u < 700; ++u) checks.at(u, v) = (u + v) % 2 == 0 && u % 7 != 0 ? 255 : 0;
  add_noise(noise, 120.0, 5);
  const VisibleRows visible = white.all_visible();
  const std::size_t before = allocations();
  for (const test::GrayPicture* const picture : {&checks, &noise, &white}) finder.find(picture->view(), visible, out);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
