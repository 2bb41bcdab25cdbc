#include "sim/renderer/image_sensor.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace azimuth {
namespace {

constexpr int kWidth = 64, kHeight = 48;
const ImageAxes kAxes{{32.0, 24.0}};

std::vector<PackedColour> rainbow() {
  std::vector<PackedColour> image;
  for (unsigned i = 0; i < kWidth * kHeight; ++i) image.push_back(colour(i % 256, (i / 7) % 256, 255 - (i / 3) % 256));
  return image;
}

std::vector<int> exposed(ImageSensor& sensor, const std::vector<PackedColour>& image, const FrameFormat& format) {
  std::vector<std::byte> bytes(format.bytes(), std::byte{0xEE});
  sensor.begin_exposure();
  sensor.read_rows(0, kHeight, image, format, bytes);
  std::vector<int> values;
  for (const std::byte each : bytes) values.push_back(std::to_integer<int>(each));
  return values;
}
std::vector<int> exposed(const std::vector<PackedColour>& image, PixelFormat pixels,
                         const ImageSensorSettings& settings = {}) {
  ImageSensor sensor(settings, kAxes, kWidth, kHeight);
  return exposed(sensor, image, packed_format(pixels, kWidth, kHeight));
}

TEST(ImageSensor, RgbIsTheColourAndBgrItsReverse) {
  const std::vector<PackedColour> image = rainbow();
  const auto rgb = exposed(image, PixelFormat::rgb8), bgr = exposed(image, PixelFormat::bgr8);
  for (std::size_t i = 0; i < image.size(); ++i) {
    ASSERT_EQ(rgb[3 * i], static_cast<int>(red_of(image[i])));
    ASSERT_EQ(rgb[3 * i + 1], static_cast<int>(green_of(image[i])));
    ASSERT_EQ(rgb[3 * i + 2], static_cast<int>(blue_of(image[i])));
    ASSERT_EQ(bgr[3 * i], rgb[3 * i + 2]);
    ASSERT_EQ(bgr[3 * i + 2], rgb[3 * i]);
  }
}

TEST(ImageSensor, GrayIsLuma) {
  const std::vector<PackedColour> image = rainbow();
  const auto gray = exposed(image, PixelFormat::gray8);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double exact = 0.299 * red_of(image[i]) + 0.587 * green_of(image[i]) + 0.114 * blue_of(image[i]);
    ASSERT_NEAR(gray[i], exact, 1.5);
  }
}

TEST(ImageSensor, YuvDecodesToTheColour) {
  for (const PackedColour paint :
       {colour(215, 25, 30), colour(10, 200, 90), colour(30, 40, 220), colour(255, 255, 255)}) {
    const std::vector<PackedColour> image(kWidth * kHeight, paint);
    const auto yuyv = exposed(image, PixelFormat::yuyv), uyvy = exposed(image, PixelFormat::uyvy);
    const double y = yuyv[0], u = yuyv[1] - 128, v = yuyv[3] - 128;
    EXPECT_NEAR(y + 1.402 * v, red_of(paint), 4);
    EXPECT_NEAR(y - 0.344 * u - 0.714 * v, green_of(paint), 4);
    EXPECT_NEAR(y + 1.772 * u, blue_of(paint), 4);
    for (std::size_t i = 0; i < yuyv.size(); i += 2) {
      ASSERT_EQ(yuyv[i], uyvy[i + 1]);
      ASSERT_EQ(yuyv[i + 1], uyvy[i]);
    }
  }
}

TEST(ImageSensor, PaddingOfRowsStaysUntouched) {
  ImageSensor sensor({}, kAxes, kWidth, kHeight);
  const FrameFormat padded{PixelFormat::gray8, kWidth, kHeight, kWidth + 10};
  const auto values = exposed(sensor, rainbow(), padded);
  for (std::size_t v = 0; v < kHeight; ++v) {
    for (std::size_t u = kWidth; u < kWidth + 10; ++u) ASSERT_EQ(values[v * (kWidth + 10) + u], 0xEE);
  }
}

TEST(ImageSensor, NoiseHasItsSigmaAndIsNewEachTime) {
  ImageSensor sensor({.noise = 3.0, .seed = 5}, kAxes, kWidth, kHeight);
  const FrameFormat format = packed_format(PixelFormat::rgb8, kWidth, kHeight);
  const std::vector<PackedColour> even(kWidth * kHeight, colour(120, 120, 120));
  std::vector<int> before;
  double sum = 0.0, squares = 0.0, products = 0.0, count = 0.0;
  for (int frame = 0; frame < 20; ++frame) {
    const auto values = exposed(sensor, even, format);
    for (std::size_t i = 0; i < values.size(); ++i, ++count) {
      sum += values[i] - 120;
      squares += (values[i] - 120) * (values[i] - 120);
      if (!before.empty()) products += (values[i] - 120) * (before[i] - 120);
    }
    before = values;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count), 3.0, 0.15);
  EXPECT_NEAR(products / count, 0.0, 0.3) << "frames are independent";
}

TEST(ImageSensor, BrightAndDarkAreCutOffNotWrapped) {
  const ImageSensorSettings noisy{.noise = 20.0, .seed = 5};
  for (const int value :
       exposed(std::vector<PackedColour>(kWidth * kHeight, colour(255, 255, 255)), PixelFormat::gray8, noisy))
    ASSERT_GT(value, 120);
  for (const int value : exposed(std::vector<PackedColour>(kWidth * kHeight, 0), PixelFormat::gray8, noisy))
    ASSERT_LT(value, 135);
}

TEST(ImageSensor, VignettingDarkensOutwards) {
  const auto values = exposed(std::vector<PackedColour>(kWidth * kHeight, colour(200, 200, 200)), PixelFormat::gray8,
                              {.vignetting = 0.4, .vignetting_radius_px = 32.0});
  const auto at = [&](std::size_t u, std::size_t v) { return values[v * kWidth + u]; };
  EXPECT_NEAR(at(32, 24), 200, 2);
  EXPECT_NEAR(at(0, 24), 200 * 0.6, 2);
  EXPECT_NEAR(at(16, 24), 200 * 0.9, 2);
}

}  // namespace
}  // namespace azimuth
