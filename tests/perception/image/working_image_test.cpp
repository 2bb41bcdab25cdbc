#include "slam/perception/image/working_image.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sim/world/random.hpp"
#include "slam/perception/image/gray.hpp"
#include "slam/perception/image/resample_kernels.hpp"
#include "tests/perception/rendered_images.hpp"

namespace azimuth {
namespace {

using test::Image;

/// An image whose grey level is a function of the pixel.
template <class Gray>
Image painted(int width_px, int height_px, const Gray& gray) {
  Image image = test::blank(PixelFormat::gray8, width_px, height_px);
  std::size_t i = 0;
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) image.bytes[i++] = static_cast<std::byte>(std::lround(gray(u, v)));
  return image;
}

Plane<std::uint16_t> made(const WorkingSquare& square, const Image& image) {
  Plane<std::uint16_t> out;
  WorkingImage(square, image.format.width_px, image.format.height_px).make(image.view(), out);
  return out;
}

TEST(WorkingSquare, HoldsTheDiscAndIsNeverEnlarged) {
  const ImageAxes axes{{320.0, 240.0}, 1.0, -1, 0.0};
  const WorkingSquare shrunk = working_square(axes, 376.0, 480), whole = working_square(axes, 376.0, 0),
                      small = working_square(axes, 100.0, 480);
  EXPECT_EQ(shrunk.side_px, 480);
  EXPECT_DOUBLE_EQ(shrunk.scale, 480.0 / 752.0);
  EXPECT_EQ(whole.side_px, 752);
  EXPECT_EQ(whole.scale, 1.0);
  EXPECT_EQ(small.side_px, 200);
  EXPECT_EQ(small.scale, 1.0);
  EXPECT_NEAR((shrunk.camera_pixel(shrunk.middle_px(), shrunk.middle_px()) - axes.centre_px).norm(), 0.0, 1e-12);
}

TEST(WorkingImage, OneGreyStaysThat) {
  const Image image = painted(100, 80, [](int, int) { return 137.0; });
  for (const ImageAxes& axes : {ImageAxes{{50.3, 40.7}}, ImageAxes{{-20.0, 200.0}}, ImageAxes{{50.0, 40.0}, 0.8}}) {
    const Plane<std::uint16_t> out = made(working_square(axes, 60.0, 48), image);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) ASSERT_EQ(out.at(x, y), 137 * 256);
  }
}

/// A linear slope must have the value of the position that camera_pixel() returns.
TEST(WorkingImage, PutsPixelsWhereTheSquareSays) {
  const Image image = painted(200, 160, [](int u, int v) { return 10.0 + 0.6 * u + 0.5 * v; });
  for (const double beta : {1.0, 0.9}) {
    for (const int most_px : {0, 100, 64, 37}) {
      const WorkingSquare square = working_square({{101.3, 80.6}, beta, -1, 0.0}, 60.0, most_px);
      const Plane<std::uint16_t> out = made(square, image);
      for (int y = 2; y < square.side_px - 2; ++y) {
        const Pixel pixel = square.camera_pixel(y, y);
        ASSERT_NEAR(out.at(y, y) / 256.0, 10.0 + 0.6 * pixel.x() + 0.5 * pixel.y(), 0.6) << most_px << " " << y;
      }
    }
  }
}

TEST(WorkingImage, WhatIsTooFineTurnsGreyInsteadOfAliasing) {
  const Image stripes = painted(300, 300, [](int u, int v) { return (u + v) % 2 == 0 ? 0.0 : 255.0; });
  const WorkingSquare square = working_square({{150.0, 150.0}}, 120.0, 140);
  const Plane<std::uint16_t> out = made(square, stripes);
  for (int y = 0; y < square.side_px; ++y)
    for (int x = 0; x < square.side_px; ++x) ASSERT_NEAR(out.at(x, y) / 256.0, 127.5, 12.0);
}

TEST(ResampleKernels, EveryProcessorAddsTheSame) {
  Random random(1, RandomPurpose::scene);
  std::vector<std::uint8_t> values(160);
  for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random.uniform(0.0, 255.9));
  for (const int count : {1, 15, 16, 17, 144, 160}) {
    std::vector<std::uint16_t> sums(160, 7), expected = sums;
    portable::add_weighted(values.data(), 201, count, sums.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      ASSERT_EQ(sums[i], expected[i] + 201 * values[i]) << count << " " << i;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") == 0) continue;
    avx2::add_weighted(values.data(), 201, count, expected.data());
    EXPECT_EQ(expected, sums);
#endif
  }
}

/// A grey pixel has the same value in every format; a Bayer mosaic mixes in its neighbours.
TEST(GrayRow, ReadsEveryFormat) {
  const Image gray = painted(64, 48, [](int u, int v) { return 20.0 + u + 2.0 * v; });
  for (const PixelFormat pixels : test::kUncompressed) {
    const Image image = test::in_format(gray, pixels);
    for (const auto& [row, first, last] : {std::array{0, 0, 64}, std::array{47, 0, 64}, std::array{20, 5, 33}}) {
      std::vector<std::uint8_t> out(64, 0);
      gray_row(image.view(), row, first, last, out.data());
      const bool mixes = pixels >= PixelFormat::bayer_rggb8;
      for (int u = first; u < last; ++u)
        ASSERT_NEAR(out[static_cast<std::size_t>(u - first)], 20 + u + 2 * row, mixes ? 2 : 0) << name(pixels);
    }
  }
}

TEST(GrayRow, WeighsColoursAsLumaDoes) {
  std::array<std::uint8_t, 1> gray{};
  for (const auto& [red, green, blue] : {std::array{255, 0, 0}, std::array{0, 255, 0}, std::array{0, 0, 255}}) {
    const auto byte = [](int value) { return static_cast<std::byte>(value); };
    const Image rgb{packed_format(PixelFormat::rgb8, 1, 1), {byte(red), byte(green), byte(blue)}};
    const Image bgr{packed_format(PixelFormat::bgr8, 1, 1), {byte(blue), byte(green), byte(red)}};
    for (const Image& image : {rgb, bgr}) {
      gray_row(image.view(), 0, 0, 1, gray.data());
      EXPECT_NEAR(gray[0], 0.299 * red + 0.587 * green + 0.114 * blue, 1.0);
    }
  }
}

}  // namespace
}  // namespace azimuth
