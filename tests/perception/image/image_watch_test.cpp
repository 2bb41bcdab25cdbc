#include "slam/perception/image/image_watch.hpp"

#include <gtest/gtest.h>
#include <random>

#include "sim/renderer/standard_cameras.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using test::Image;

const ImageRig kMirrorRig = standard_camera("mirror")->image;

ImageTrouble trouble_of(const Image& image, const ImageRig& rig = kMirrorRig) {
  return ImageWatch(rig).judge(image.view());
}

/// A uniform grey image with sensor noise.
Image plain(PixelFormat pixels, double level, double noise) {
  Image image = test::blank(pixels, 1024, 768);
  std::minstd_rand random(7);
  std::normal_distribution<double> brightness(level, noise);
  for (std::byte& byte : image.bytes) byte = static_cast<std::byte>(std::clamp(brightness(random), 0.0, 255.0));
  return image;
}

class WatchedFormat : public testing::TestWithParam<PixelFormat> {};
INSTANTIATE_TEST_SUITE_P(Each, WatchedFormat, testing::ValuesIn(test::kUncompressed), test::PrintedName());

TEST_P(WatchedFormat, FindsNothingWrongWithARoom) {
  EXPECT_EQ(trouble_of(test::in_format(test::mirror_image(), GetParam())), ImageTrouble::none);
}

TEST_P(WatchedFormat, TellsDarkWhiteAndGrey) {
  EXPECT_EQ(trouble_of(plain(GetParam(), 0.0, 0.0)), ImageTrouble::dark);
  EXPECT_EQ(trouble_of(plain(GetParam(), 6.0, 3.0)), ImageTrouble::dark);
  EXPECT_EQ(trouble_of(plain(GetParam(), 255.0, 0.0)), ImageTrouble::overexposed);
  EXPECT_EQ(trouble_of(plain(GetParam(), 130.0, 0.0)), ImageTrouble::featureless);
  EXPECT_EQ(trouble_of(plain(GetParam(), 130.0, 3.0)), ImageTrouble::featureless);
}

TEST_P(WatchedFormat, RefusesWhatIsCutShort) {
  Image image = test::in_format(test::mirror_image(), GetParam());
  image.bytes.pop_back();
  EXPECT_EQ(trouble_of(image), ImageTrouble::unreadable);
}

TEST(ImageWatch, RefusesImagesOfAnotherSizeAndFormat) {
  EXPECT_EQ(trouble_of(test::blank(PixelFormat::gray8, 640, 480)), ImageTrouble::unreadable);
  EXPECT_EQ(ImageWatch(kMirrorRig).judge({}), ImageTrouble::unreadable);
  Image compressed = test::mirror_image();
  compressed.format = {PixelFormat::mjpeg, 1024, 768, 0};
  EXPECT_EQ(trouble_of(compressed), ImageTrouble::unreadable);
}

TEST(ImageWatch, TakesAnySizeWhenTheRigSaysNone) {
  ImageWatch watch{ImageRig{}};
  EXPECT_EQ(watch.judge(test::mirror_image().view()), ImageTrouble::none);
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 700}, {700, 3}, {4, 4}, {2048, 1536}}) {
    const Image black = test::blank(PixelFormat::gray8, width, height);
    EXPECT_EQ(watch.judge(black.view()), width < 4 ? ImageTrouble::none : ImageTrouble::dark) << width;
  }
}

TEST(ImageWatch, LampsInTheDarkAreEnough) {
  EXPECT_EQ(trouble_of(test::lamps_image(), standard_camera("fisheye")->image), ImageTrouble::none);
}

TEST(ImageWatch, HalfTheLightIsNoTrouble) {
  ImageWatch watch(kMirrorRig);
  const Image room = test::mirror_image();
  for (const double light : {1.0, 0.5, 1.0, 0.7, 0.35, 1.0, 1.4, 0.7}) {
    EXPECT_EQ(watch.judge(test::scaled(room, light).view()), ImageTrouble::none) << light;
  }
}

TEST(ImageWatch, MoreAndMoreLightEndsInWhite) {
  const Image room = test::mirror_image();
  EXPECT_EQ(trouble_of(test::scaled(room, 20.0)), ImageTrouble::overexposed);
  EXPECT_EQ(trouble_of(test::scaled(room, 0.05)), ImageTrouble::dark);
}

TEST(ImageWatch, LooksOnlyAtWhatTheMaskShows) {
  const Image room = test::mirror_image();
  const Image black = test::blank(PixelFormat::gray8, 1024, 768);
  Image white = black;
  std::fill(white.bytes.begin(), white.bytes.end(), std::byte{255});
  EXPECT_EQ(trouble_of(test::combined(room, white, kMirrorRig)), ImageTrouble::none);
  EXPECT_EQ(trouble_of(test::combined(black, room, kMirrorRig)), ImageTrouble::dark);
  EXPECT_EQ(trouble_of(test::combined(white, black, kMirrorRig)), ImageTrouble::overexposed);
}

TEST(ImageWatch, CountsTheSameImageAgainAndAgain) {
  ImageWatch watch(kMirrorRig);
  const Image room = test::mirror_image();
  const int enough = ImageWatchSettings{}.frozen_repeats;
  for (int i = 0; i < enough; ++i) {
    EXPECT_EQ(watch.judge(room.view()), ImageTrouble::none) << i;
    EXPECT_EQ(watch.repeats(), i);
  }
  EXPECT_EQ(watch.judge(room.view()), ImageTrouble::frozen);
  EXPECT_EQ(watch.judge(room.view()), ImageTrouble::frozen);
  EXPECT_EQ(watch.repeats(), enough + 1);

  Image noisy = room;
  for (std::size_t v = 384; v < 394; ++v) noisy.bytes[v * 1024 + 700] ^= std::byte{1};
  EXPECT_EQ(watch.judge(noisy.view()), ImageTrouble::none) << "the last bit of ten pixels";
  EXPECT_EQ(watch.repeats(), 0);
}

TEST(ImageWatch, NoiseIsNeverFrozen) {
  ImageWatch watch(kMirrorRig);
  RenderCamera camera = test::mirror_camera();
  camera.sensor.noise = 1.0;
  Renderer renderer(test::lab_scene(), camera);
  Image image = test::blank(PixelFormat::gray8, camera.width_px, camera.height_px);
  for (int i = 0; i < 2 * ImageWatchSettings{}.frozen_repeats; ++i) {
    renderer.render({}, {image.format, image.bytes});
    EXPECT_EQ(watch.judge(image.view()), ImageTrouble::none);
    EXPECT_EQ(watch.repeats(), 0);
  }
}

TEST(ImageWatch, AllocatesOnlyForTheFirstImage) {
  ImageWatch watch(kMirrorRig);
  const Image room = test::mirror_image();
  watch.judge(room.view());
  const std::size_t before = allocations();
  for (int i = 0; i < 3; ++i) watch.judge(room.view());
  EXPECT_EQ(allocations(), before);
}

TEST(ImageWatch, AMaskThatHidesEverythingIsNotTheImagesFault) {
  ImageRig rig = kMirrorRig;
  rig.mask_polygons_px = {{{-10.0, -10.0}, {2000.0, -10.0}, {2000.0, 2000.0}, {-10.0, 2000.0}}};
  EXPECT_EQ(trouble_of(test::blank(PixelFormat::gray8, 1024, 768), rig), ImageTrouble::none);
}

}  // namespace
}  // namespace azimuth
