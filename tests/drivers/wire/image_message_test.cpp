#include "drivers/wire/image_message.hpp"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "drivers/wire/messages.hpp"
#include "tests/drivers/wire/sample_messages.hpp"

namespace azimuth {
namespace {

using namespace test;

image_t message_of(PixelFormat pixels, int width_px, int height_px, int padding = 0) {
  FrameFormat format = packed_format(pixels, width_px, height_px);
  format.stride_bytes += padding;
  const std::size_t size = pixels == PixelFormat::mjpeg ? 100 : format.bytes();
  Buffer bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i);
  image_t message{};
  fill_message({format, bytes}, stamp_from_us(1'700'000'000'000'007), message);
  return message;
}

bool points_into(Bytes part, Bytes whole) {
  return part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size();
}

TEST(ImageMessage, EveryFormatComesBack) {
  for (int number = 0; number < kPixelFormats; ++number) {
    const auto pixels = static_cast<PixelFormat>(number);
    const image_t message = message_of(pixels, 24, 10, pixels == PixelFormat::mjpeg ? 0 : 6);
    const Buffer data = encoded(message);
    const auto back = decode_image(data);
    ASSERT_TRUE(back) << name(pixels);
    EXPECT_TRUE(back->supported);
    EXPECT_EQ(back->stamp, stamp_from_us(1'700'000'000'000'007));
    EXPECT_EQ(back->image.format, (FrameFormat{pixels, 24, 10, message.row_stride}));
    EXPECT_TRUE(points_into(back->image.bytes, data)) << "a copy is not wanted";
    EXPECT_TRUE(std::ranges::equal(back->image.bytes, std::as_bytes(std::span(message.data))));
  }
}

/// bot_core defines the names and numbers of the formats; they must not change.
TEST(ImageMessage, NumbersAreFourLetterCodes) {
  const auto code = [](const char(&letters)[5]) {
    std::int32_t number = 0;
    for (int i = 3; i >= 0; --i) number = number * 256 + letters[i];
    return number;
  };
  EXPECT_EQ(image_t::PIXEL_FORMAT_GRAY, code("GREY"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_NV12, code("NV12"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_YUYV, code("YUYV"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_UYVY, code("UYVY"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_RGB, code("RGB3"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_BGR, code("BGR3"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_BAYER_BGGR, code("BA81"));
  EXPECT_EQ(image_t::PIXEL_FORMAT_MJPEG, code("MJPG"));
}

TEST(ImageMessage, MetadataIsPassedOver) {
  image_t message = message_of(PixelFormat::gray8, 8, 8);
  message.nmetadata = 2;
  message.metadata.resize(2);
  message.metadata[0].key = "Shutter";
  message.metadata[0].n = 5;
  message.metadata[0].value.resize(5);
  message.metadata[1].n = 0;
  const Buffer data = encoded(message);
  const auto back = decode_image(data);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->image.bytes.size(), 64U);
  for (std::size_t length = 0; length < data.size(); ++length) EXPECT_FALSE(decode_image(Bytes(data).first(length)));
}

TEST(ImageMessage, NoStrideMeansNoPadding) {
  image_t message = message_of(PixelFormat::rgb8, 8, 8);
  message.row_stride = 0;
  const Buffer data = encoded(message);
  const auto back = decode_image(data);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->image.format, packed_format(PixelFormat::rgb8, 8, 8));
}

TEST(ImageMessage, AnUnreadableImageIsAnEmptyJpeg) {
  image_t message = message_of(PixelFormat::gray8, 8, 8);
  fill_message({}, stamp_from_us(5), message);
  const Buffer data = encoded(message);
  const auto back = decode_image(data);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->supported);
  EXPECT_EQ(back->image.format.pixels, PixelFormat::mjpeg);
  EXPECT_TRUE(back->image.bytes.empty());
}

TEST(ImageMessage, OtherFormatsAreNotSupported) {
  for (const std::int32_t number : {876758866 /* RGBA */, 357 /* 16 bit */, 0, -2}) {
    image_t message = message_of(PixelFormat::gray8, 8, 8);
    message.pixelformat = number;
    const Buffer data = encoded(message);
    const auto back = decode_image(data);
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->supported);
    EXPECT_TRUE(back->image.bytes.empty());
  }
}

TEST(ImageMessage, WhatCannotBeIsRefused) {
  const std::function<void(image_t&)> wrongs[] = {[](image_t& m) { m.width = 0; },
                                                  [](image_t& m) { m.height = -8; },
                                                  [](image_t& m) { m.height = 9; },
                                                  [](image_t& m) { m.row_stride = 7; },
                                                  [](image_t& m) { m.row_stride = 9; },
                                                  [](image_t& m) { m.width = 1 << 30; },
                                                  [](image_t& m) { m.size = 63, m.data.resize(63); },
                                                  [](image_t& m) { m.utime = std::int64_t{1} << 62; }};
  for (const auto& wrong : wrongs) {
    image_t message = message_of(PixelFormat::gray8, 8, 8);
    wrong(message);
    EXPECT_FALSE(decode_image(encoded(message)));
  }
}

TEST(ImageMessage, LyingLengthsAreRefused) {
  const Buffer good = encoded(message_of(PixelFormat::gray8, 8, 8));
  const std::size_t size_at = 8 + 8 + 16, metadata_at = size_at + 4 + 64;
  for (const std::size_t at : {size_at, metadata_at}) {
    for (const unsigned lie : {1U, 63U, 65U, 1000U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
      Buffer data = good;
      for (std::size_t i = 0; i < 4; ++i) data[at + i] = static_cast<std::byte>(lie >> (24 - 8 * i));
      EXPECT_FALSE(decode_image(data)) << at << ' ' << lie;
    }
  }
}

TEST(ImageMessage, ChangedBytesNeverBreakTheDecoder) {
  std::mt19937_64 bits(3);  // NOLINT(cert-msc51-cpp): the same every time
  const Buffer good = encoded(message_of(PixelFormat::yuyv, 8, 4));
  int supported = 0;
  for (int round = 0; round < 50'000; ++round) {
    Buffer data = good;
    for (auto changes = 1 + bits() % 3; changes-- > 0;)
      data[16 + bits() % (data.size() - 16)] = static_cast<std::byte>(bits());
    const auto back = decode_image(data);
    if (!back || !back->supported) continue;
    ++supported;
    EXPECT_TRUE(points_into(back->image.bytes, data));
    EXPECT_TRUE(back->image.format.pixels == PixelFormat::mjpeg || back->image.readable());
  }
  EXPECT_GT(supported, 1000);
}

}  // namespace
}  // namespace azimuth
