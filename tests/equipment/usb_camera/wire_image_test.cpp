#include "tests/equipment/usb_camera/wire_image.hpp"

#include <array>
#include <gtest/gtest.h>

#include "drivers/camera/jpeg.hpp"
#include "tests/equipment/usb_camera/image_feed.hpp"

namespace azimuth::sim::test {
namespace {

constexpr std::array kRawFormats{WireFormat::yuyv, WireFormat::uyvy, WireFormat::grey, WireFormat::nv12};

/// An image of one colour.
std::vector<std::byte> flat(int width_px, int height_px, std::array<int, 3> rgb) {
  std::vector<std::byte> bytes;
  for (int i = 0; i < width_px * height_px; ++i) {
    for (const int value : rgb) bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

TEST(Pattern, KnowsItsNumberAndEveryDamagedByte) {
  for (const WireFormat format : kRawFormats) {
    const WireShape shape{format, 16, 4};
    Octets image;
    for (const std::uint32_t number : {0U, 1U, 255U, 256U, 70'000U, 0xffffffffU}) {
      fill_pattern(shape, number, image);
      EXPECT_EQ(image.size(), shape.bytes());
      EXPECT_EQ(check_pattern(shape, image), number);
    }
    for (std::size_t place = 4; place < image.size(); ++place) {
      image[place] ^= 1U;
      EXPECT_FALSE(check_pattern(shape, image));
      image[place] ^= 1U;
    }
    EXPECT_FALSE(check_pattern(shape, OctetSpan(image).first(image.size() - 1)));
    EXPECT_FALSE(check_pattern(shape, {}));
  }
}

TEST(Pattern, ImagesThatFollowEachOtherDifferThroughout) {
  const WireShape shape{WireFormat::grey, 32, 32};
  Octets first, second;
  fill_pattern(shape, 8, first);
  fill_pattern(shape, 9, second);
  for (std::size_t i = 4; i < first.size(); ++i) EXPECT_NE(first[i], second[i]);
}

TEST(Conversion, HasTheColoursOfBt601) {
  struct Case {
    std::array<int, 3> rgb;
    std::uint8_t y, u, v, grey;
  };
  for (const Case& one :
       {Case{{255, 255, 255}, 235, 128, 128, 255}, Case{{0, 0, 0}, 16, 128, 128, 0}, Case{{255, 0, 0}, 82, 90, 240, 77},
        Case{{0, 255, 0}, 144, 54, 34, 149}, Case{{0, 0, 255}, 41, 240, 110, 29}}) {
    const std::vector<std::byte> pixels = flat(4, 2, one.rgb);
    const ImageView image{packed_format(PixelFormat::rgb8, 4, 2), pixels};
    Octets into;
    const auto convert = [&](WireFormat format) {
      const WireShape shape{format, 4, 2};
      EXPECT_TRUE(is_convertible(image, shape));
      convert_image(image, shape, into);
      EXPECT_EQ(into.size(), shape.bytes());
    };
    convert(WireFormat::yuyv);
    EXPECT_EQ(Octets(into.begin(), into.begin() + 4), (Octets{one.y, one.u, one.y, one.v}));
    convert(WireFormat::uyvy);
    EXPECT_EQ(Octets(into.begin(), into.begin() + 4), (Octets{one.u, one.y, one.v, one.y}));
    convert(WireFormat::nv12);
    EXPECT_EQ(into[7], one.y);
    EXPECT_EQ(Octets(into.begin() + 8, into.begin() + 10), (Octets{one.u, one.v}));
    convert(WireFormat::grey);
    EXPECT_NEAR(into[0], one.grey, 1);
  }
}

TEST(Conversion, RefusesOtherSizesAndFormats) {
  const std::vector<std::byte> pixels = flat(4, 2, {1, 2, 3});
  const ImageView image{packed_format(PixelFormat::rgb8, 4, 2), pixels};
  EXPECT_FALSE(is_convertible(image, {WireFormat::yuyv, 2, 4}));
  EXPECT_FALSE(is_convertible({packed_format(PixelFormat::yuyv, 4, 2), pixels}, {WireFormat::yuyv, 4, 2}));
  EXPECT_FALSE(is_convertible({image.format, image.bytes.first(5)}, {WireFormat::yuyv, 4, 2}));
}

TEST(JpegTag, SurvivesAndLeavesTheImageReadable) {
  PatternFeed feed;
  Octets file;
  ASSERT_TRUE(feed.fill({WireFormat::mjpeg, 64, 48}, 1234567, file));
  EXPECT_EQ(jpeg_tag(file), 1234567U);
  JpegDecoder decoder;
  const ImageView image = decoder.decode(std::as_bytes(std::span(file)), PixelFormat::gray8);
  ASSERT_FALSE(image.bytes.empty());
  EXPECT_EQ(image.format.width_px, 64);
  EXPECT_EQ(image.format.height_px, 48);
}

TEST(JpegTag, IsNotFoundElsewhere) {
  Octets file;
  PatternFeed().fill({WireFormat::mjpeg, 64, 48}, 7, file);
  EXPECT_FALSE(jpeg_tag(OctetSpan(file).first(9)));
  EXPECT_FALSE(jpeg_tag({}));
  file[3] = 0xe0;
  EXPECT_FALSE(jpeg_tag(file));
}

TEST(WireFormatName, OfEachFormat) {
  EXPECT_EQ(wire_format("nv12"), WireFormat::nv12);
  EXPECT_EQ(wire_format("mjpeg"), WireFormat::mjpeg);
  EXPECT_FALSE(wire_format("h264"));
}

}  // namespace
}  // namespace azimuth::sim::test
