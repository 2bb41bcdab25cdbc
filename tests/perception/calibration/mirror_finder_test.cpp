#include "slam/perception/calibration/mirror_finder.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/perception/rendered_images.hpp"

namespace azimuth {
namespace {

using test::Image;

std::optional<MirrorCircle> found_in(const std::vector<Image>& images) {
  MirrorFinder finder;
  for (const Image& image : images) EXPECT_TRUE(finder.add(image.view()));
  return finder.find();
}

/// The surroundings of the mirror in the image.
enum class Around { black, gray_noise, stripes };

struct Case {
  std::string name;
  Pixel centre_px;
  double inner_px = 60.0, outer_px = 300.0;
  Around around = Around::black;
  double noise = 0.0;
  int images = 1;
};
std::ostream& operator<<(std::ostream& out, const Case& each) { return out << each.name; }

void paint_around(Image& image, const Case& mirror) {
  const ImageMask rim(ImageAxes{mirror.centre_px}, {0.0, mirror.outer_px, {}});
  std::minstd_rand random(5);
  for (int v = 0; v < image.format.height_px; ++v) {
    for (int u = 0; u < image.format.width_px; ++u) {
      if (mirror.around == Around::black || rim.visible({u, v})) continue;
      const int level = mirror.around == Around::stripes ? ((u + 2 * v) / 90 % 2 == 0 ? 70 : 150)
                                                         : 110 + static_cast<int>(random() % 13);
      image.bytes[static_cast<std::size_t>(v * image.format.width_px + u)] = static_cast<std::byte>(level);
    }
  }
}

std::vector<Image> images_of(const Case& mirror) {
  RenderCamera camera = test::mirror_camera();
  // The horizon is at 0.8 of the rim radius, as in the standard camera.
  const ImageAxes axes{mirror.centre_px, 1.0, -1, -kPi / 2};
  camera.model = CameraModel(axes, HyperbolicMirror{28.095, 23.4125, 1035.376 * mirror.outer_px / 376.0});
  camera.mask = {mirror.inner_px, mirror.outer_px, {}};
  camera.sensor.noise = mirror.noise;
  std::vector<Image> images;
  for (int i = 0; i < mirror.images; ++i) {
    images.push_back(test::rendered(test::lab_scene(), camera, {2.0 + 0.8 * i, 1.5 + 0.2 * i, 0.5 * i}));
    paint_around(images.back(), mirror);
  }
  return images;
}

class RenderedMirror : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Each, RenderedMirror,
                         testing::Values(Case{"in_the_middle", {511.5, 383.5}}, Case{"off_to_a_side", {600.25, 340.75}},
                                         Case{"small", {400.0, 300.0}, 30.0, 160.0},
                                         Case{"large", {512.0, 384.0}, 60.0, 376.0},
                                         Case{"cut_by_two_sides", {512.0, 384.0}, 70.0, 440.0},
                                         Case{"cut_at_the_top", {530.0, 250.0}, 60.0, 330.0},
                                         Case{"noisy", {511.5, 400.5}, 60.0, 300.0, Around::gray_noise, 6.0},
                                         Case{"before_stripes", {480.0, 390.0}, 60.0, 290.0, Around::stripes, 2.0, 4}),
                         [](const auto& test) { return test.param.name; });

TEST_P(RenderedMirror, IsFoundWithinAPixelAndAHalf) {
  const Case& mirror = GetParam();
  const std::optional<MirrorCircle> found = found_in(images_of(mirror));
  ASSERT_TRUE(found);
  EXPECT_LT((found->rim.centre_px - mirror.centre_px).norm(), 1.5) << found->rim.centre_px.transpose();
  EXPECT_NEAR(found->rim.radius_px, mirror.outer_px, 1.5);
  EXPECT_GT(found->sigma_centre_px, 0.0);
  EXPECT_LT(found->sigma_centre_px, 1.0);
  ASSERT_TRUE(found->inner);
  EXPECT_LT((found->inner->centre_px - mirror.centre_px).norm(), 4.0);
  EXPECT_NEAR(found->inner->radius_px, mirror.inner_px, 4.0);
}

TEST(MirrorFinder, SaysHowMuchOfTheRimIsInTheImage) {
  EXPECT_GT(found_in(images_of({"whole", {511.5, 383.5}}))->rim_in_image, 0.99);
  EXPECT_LT(found_in(images_of({"cut", {512.0, 384.0}, 70.0, 440.0}))->rim_in_image, 0.75);
}

TEST(MirrorFinder, SameImagesSameCircle) {
  const std::vector<Image> images = images_of({"twice", {500.0, 380.0}});
  EXPECT_EQ(found_in(images)->rim.centre_px, found_in(images)->rim.centre_px);
}

/// The mirror's image unrolled to a panorama, similar to the view of a lens camera.
Image panorama() {
  const Image& mirror = test::mirror_image();
  Image image = test::blank(PixelFormat::gray8, 1024, 512);
  const ImageAxes axes{{512.0, 384.0}};
  for (int v = 0; v < 512; ++v) {
    for (int u = 0; u < 1024; ++u) {
      const Pixel from = axes.pixel({370.0 - 0.55 * v, -kPi + u * 2.0 * kPi / 1024.0});
      const auto row = static_cast<std::size_t>(std::lround(from.y())),
                 column = static_cast<std::size_t>(std::lround(from.x()));
      image.bytes[static_cast<std::size_t>(v * 1024 + u)] = mirror.bytes[row * 1024 + column];
    }
  }
  return image;
}

template <class Level>
Image drawn(Level level) {
  Image image = test::blank(PixelFormat::gray8, 640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u)
      image.bytes[static_cast<std::size_t>(v * 640 + u)] = static_cast<std::byte>(level(u, v));
  }
  return image;
}

TEST(MirrorFinder, FindsNoneWhereThereIsNone) {
  std::minstd_rand random(3);
  EXPECT_FALSE(found_in({panorama()})) << "a room";
  EXPECT_FALSE(found_in({drawn([](int, int) { return 0; })})) << "black";
  EXPECT_FALSE(found_in({drawn([](int, int) { return 255; })})) << "white";
  EXPECT_FALSE(found_in({drawn([](int u, int v) { return (u + v) / 5; })})) << "a gradient";
  EXPECT_FALSE(found_in({drawn([&](int, int) { return static_cast<int>(random() % 256); })})) << "noise";
  for (const int square : {17, 40, 73}) {
    EXPECT_FALSE(found_in({drawn([&](int u, int v) { return (u / square + v / square) % 2 == 0 ? 40 : 210; })}))
        << "a checkerboard of " << square;
  }
  EXPECT_FALSE(found_in({drawn([](int u, int v) { return std::hypot(u - 320, v - 240) < 150 ? 200 : 30; })}))
      << "a ball: nothing is to be seen in it";
  EXPECT_FALSE(MirrorFinder().find()) << "no image at all";
}

TEST(MirrorFinder, TakesOnlyReadableImagesOfOneSize) {
  MirrorFinder finder;
  EXPECT_FALSE(finder.add({}));
  EXPECT_FALSE(finder.add(test::blank(PixelFormat::gray8, 63, 480).view()));
  EXPECT_TRUE(finder.add(test::blank(PixelFormat::gray8, 640, 480).view()));
  EXPECT_FALSE(finder.add(test::blank(PixelFormat::gray8, 480, 640).view()));
  EXPECT_TRUE(finder.add(test::blank(PixelFormat::rgb8, 640, 480).view()));
  EXPECT_EQ(finder.images(), 2);
}

TEST(MirrorFinder, FindsItInEveryFormat) {
  const Image image = images_of({"formats", {500.0, 380.0}}).front();
  for (const PixelFormat pixels : {PixelFormat::yuyv, PixelFormat::bgr8, PixelFormat::bayer_rggb8}) {
    const std::optional<MirrorCircle> found = found_in({test::in_format(image, pixels)});
    ASSERT_TRUE(found) << name(pixels);
    EXPECT_LT((found->rim.centre_px - Pixel(500.0, 380.0)).norm(), 1.5) << name(pixels);
  }
}

}  // namespace
}  // namespace azimuth
