#include "drivers/camera/png.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <zlib.h>

#include "drivers/wire/image_header.hpp"
#include "tests/support/cpu_time.hpp"
#include "tests/support/data.hpp"
#include "tests/support/png_file.hpp"

namespace azimuth {
namespace {

using Buffer = std::vector<std::byte>;
using Values = std::vector<int>;
using test::PngColour;
using test::PngFile;

Values values(const ImageView& image) {
  Values out;
  for (const std::byte byte : image.bytes) out.push_back(std::to_integer<int>(byte));
  return out;
}

/// The decoded pixels of a file; empty if the decoder rejects it.
Values decoded(const Buffer& png, PixelFormat pixels) {
  PngDecoder decoder;
  const ImageView image = decoder.decode(png, pixels);
  EXPECT_EQ(image.bytes.empty(), !decoder.problem().empty());
  EXPECT_TRUE(image.bytes.empty() || image.readable());
  return values(image);
}

/// Two rows of three pixels.
Buffer grey_png() { return PngFile(3, 2, 8, PngColour::gray).pixels({0, 1, 2, 3, 0, 4, 5, 255}).end(); }
/// Two pixels.
Buffer colour_png() { return PngFile(2, 1, 8, PngColour::rgb).pixels({0, 200, 100, 50, 1, 2, 3}).end(); }

TEST(Png, HeaderSaysSizeAndColour) {
  PngDecoder decoder;
  EXPECT_EQ(decoder.read_header(grey_png()), (PngHeader{3, 2, false}));
  EXPECT_EQ(decoder.read_header(grey_png())->natural_format(), PixelFormat::gray8);
  EXPECT_EQ(decoder.read_header(colour_png()), (PngHeader{2, 1, true}));
  EXPECT_EQ(decoder.read_header(colour_png())->natural_format(), PixelFormat::rgb8);
  EXPECT_EQ(decoder.problem(), "");
}

TEST(Png, PixelsComeWithoutLoss) {
  EXPECT_EQ(decoded(grey_png(), PixelFormat::gray8), (Values{1, 2, 3, 4, 5, 255}));
  EXPECT_EQ(decoded(colour_png(), PixelFormat::rgb8), (Values{200, 100, 50, 1, 2, 3}));
  EXPECT_EQ(decoded(colour_png(), PixelFormat::bgr8), (Values{50, 100, 200, 3, 2, 1}));
}

/// Compressed texts that expand a thousandfold, up to and beyond libpng's own limits, must not be expanded.
TEST(Png, TextsAreNotUnpacked) {
  std::vector<std::uint8_t> zeros(7'000'000), text{'a', 0, 0};
  uLongf size = compressBound(zeros.size());
  text.resize(3 + size);
  ASSERT_EQ(compress2(text.data() + 3, &size, zeros.data(), zeros.size(), 9), Z_OK);
  text.resize(3 + size);
  PngFile bomb(3, 2, 8, PngColour::gray);
  for (int i = 0; i < 50; ++i) bomb.chunk("zTXt", text);
  bomb.pixels({0, 1, 2, 3, 0, 4, 5, 255});
  for (int i = 0; i < 50; ++i) bomb.chunk("zTXt", text);
  const double begin_s = cpu_time_s();
  EXPECT_EQ(decoded(bomb.end(), PixelFormat::gray8), (Values{1, 2, 3, 4, 5, 255}));
  EXPECT_LT(cpu_time_s() - begin_s, 0.5);
}

TEST(Png, WhatPixelsNeedIsKept) {
  // A palette with one transparent colour, after a text chunk.
  const Buffer png = PngFile(2, 1, 8, PngColour::palette)
                         .chunk("tEXt", {'a', 0, 'b'})
                         .chunk("PLTE", {10, 20, 30, 40, 50, 60})
                         .chunk("tRNS", {255, 0})
                         .pixels({0, 0, 1})
                         .end();
  EXPECT_EQ(decoded(png, PixelFormat::rgb8), (Values{10, 20, 30, 0, 0, 0}));
}

TEST(Png, GreyMakesGreyColoursAndColoursBrightness) {
  EXPECT_EQ(decoded(grey_png(), PixelFormat::rgb8),
            (Values{1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 255, 255, 255}));
  // 0.299 red + 0.587 green + 0.114 blue
  EXPECT_EQ(decoded(colour_png(), PixelFormat::gray8), (Values{124, 2}));
}

TEST(Png, EveryDepth) {
  EXPECT_EQ(decoded(PngFile(8, 1, 1, PngColour::gray).pixels({0, 0b10110001}).end(), PixelFormat::gray8),
            (Values{255, 0, 255, 255, 0, 0, 0, 255}));
  EXPECT_EQ(decoded(PngFile(4, 1, 2, PngColour::gray).pixels({0, 0b00011011}).end(), PixelFormat::gray8),
            (Values{0, 85, 170, 255}));
  EXPECT_EQ(decoded(PngFile(2, 1, 4, PngColour::gray).pixels({0, 0x0F}).end(), PixelFormat::gray8), (Values{0, 255}));
  // 16-bit values are scaled linearly, without gamma correction.
  EXPECT_EQ(
      decoded(PngFile(3, 1, 16, PngColour::gray).pixels({0, 0, 0, 0x40, 0x40, 0xFF, 0xFF}).end(), PixelFormat::gray8),
      (Values{0, 64, 255}));
}

TEST(Png, PalettesInterlacedRowsAndWhatIsTransparent) {
  EXPECT_EQ(decoded(PngFile(2, 1, 8, PngColour::palette).chunk("PLTE", {9, 8, 7, 50, 60, 70}).pixels({0, 1, 0}).end(),
                    PixelFormat::rgb8),
            (Values{50, 60, 70, 9, 8, 7}));
  // In a 2 x 2 image, the first pass holds the first pixel, the sixth pass its right neighbour, the seventh the second
  // row.
  EXPECT_EQ(decoded(PngFile(2, 2, 8, PngColour::gray, true).pixels({0, 1, 0, 2, 0, 3, 4}).end(), PixelFormat::gray8),
            (Values{1, 2, 3, 4}));
  EXPECT_EQ(decoded(PngFile(2, 1, 8, PngColour::gray_alpha).pixels({0, 90, 255, 90, 0}).end(), PixelFormat::gray8),
            (Values{90, 0}));
  EXPECT_EQ(decoded(PngFile(1, 1, 8, PngColour::rgb_alpha).pixels({0, 9, 8, 7, 0}).end(), PixelFormat::rgb8),
            (Values{0, 0, 0}));
}

TEST(Png, CutAnywhereBeforeItsEndIsRefused) {
  const Buffer whole = grey_png();
  constexpr std::size_t kLastChunk = 12;  // it contains no pixels
  PngDecoder decoder;
  for (std::size_t length = 0; length < whole.size() - kLastChunk; ++length) {
    EXPECT_TRUE(decoder.decode(std::span(whole).first(length), PixelFormat::gray8).bytes.empty()) << length;
    EXPECT_NE(decoder.problem(), "");
  }
  EXPECT_TRUE(decoder.decode(whole, PixelFormat::gray8).readable()) << "unharmed by what it refused";
}

TEST(Png, DamageShows) {
  const Buffer whole = grey_png();
  PngDecoder decoder;
  constexpr std::size_t kBeforePixels = 33 + 8, kAfterPixels = 12;
  for (std::size_t at = kBeforePixels; at < whole.size() - kAfterPixels; ++at) {
    Buffer damaged = whole;
    damaged[at] ^= std::byte{0x10};
    EXPECT_TRUE(decoder.decode(damaged, PixelFormat::gray8).bytes.empty()) << at;
  }
}

TEST(Png, RowsThatAreMissingAreNotMadeUp) {
  EXPECT_EQ(decoded(PngFile(3, 2, 8, PngColour::gray).pixels({0, 1, 2, 3}).end(), PixelFormat::gray8), Values{});
  EXPECT_EQ(decoded(PngFile(3, 1, 8, PngColour::gray).end(), PixelFormat::gray8), Values{});
  EXPECT_EQ(decoded(PngFile(2, 1, 8, PngColour::palette).pixels({0, 1, 0}).end(), PixelFormat::rgb8), Values{});
}

TEST(Png, BytesAfterTheEndDoNoHarm) {
  Buffer png = grey_png();
  png.resize(png.size() + 500);
  EXPECT_EQ(decoded(png, PixelFormat::gray8).size(), 6u);
}

TEST(Png, HeaderThatClaimsTooMuchIsRefused) {
  PngDecoder decoder;
  const auto header = [&](int width_px, int height_px) {
    return decoder.read_header(PngFile(width_px, height_px, 8, PngColour::gray).pixels({0, 1}).end());
  };
  EXPECT_TRUE(header(8192, 4096));
  EXPECT_FALSE(header(8192, 4097));
  EXPECT_EQ(decoder.problem(), "is too large");
  EXPECT_FALSE(header(16385, 1));
  EXPECT_FALSE(header(1 << 30, 1 << 30));
  EXPECT_FALSE(header(0, 4));
}

TEST(Png, RefusesFormatsThatNeedMoreThanDecoding) {
  for (const PixelFormat pixels : {PixelFormat::yuyv, PixelFormat::bayer_rggb8, PixelFormat::mjpeg})
    EXPECT_EQ(decoded(grey_png(), pixels), Values{}) << name(pixels);
}

/// The checksum of the header chunk is corrected, so that the decoder uses the changed header.
TEST(Png, AnyBytesAreSafe) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same every time
  const auto value = [&random] { return static_cast<std::uint8_t>(random()); };
  PngDecoder decoder;
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    constexpr PngColour kColours[] = {PngColour::gray, PngColour::rgb, PngColour::palette, PngColour::gray_alpha,
                                      PngColour::rgb_alpha};
    PngFile file(1 + value() % 9, 1 + value() % 9, 1 << (value() % 5), kColours[value() % 5], value() % 2 == 0);
    const auto some = [&](std::size_t most) {
      std::vector<std::uint8_t> content(random() % most);
      std::ranges::generate(content, value);
      return content;
    };
    if (value() % 2 == 0) file.chunk("PLTE", some(40));
    if (value() % 4 == 0) file.chunk("tRNS", some(10));
    if (value() % 4 == 0) file.chunk("gAMA", some(6));
    std::vector<std::uint8_t> rows = some(900);
    for (std::uint8_t& each : rows) each = value() % 2 == 0 ? 0 : each;
    const Buffer png = file.pixels(rows).end();
    for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8})
      accepted += decoder.decode(png, pixels).readable() ? 1 : 0;
  }
  EXPECT_GT(accepted, 100) << "hardly anything is read";
  EXPECT_LT(accepted, 5000);
}

TEST(Png, StorageIsKeptAndNothingOfTheLastImageShows) {
  PngDecoder decoder;
  const std::byte* const pixels = decoder.decode(grey_png(), PixelFormat::rgb8).bytes.data();
  const Buffer clear = PngFile(1, 1, 8, PngColour::rgb_alpha).pixels({0, 9, 8, 7, 0}).end();
  const ImageView second = decoder.decode(clear, PixelFormat::rgb8);
  EXPECT_EQ(second.bytes.data(), pixels);
  EXPECT_EQ(values(second), (Values{0, 0, 0}));
}

TEST(Png, IsToldByItsFirstBytes) {
  const Buffer png = grey_png();
  EXPECT_TRUE(is_png(png));
  EXPECT_FALSE(is_png(std::span(png).first(7)));
  EXPECT_FALSE(is_png(std::span(png).subspan(1)));
  EXPECT_FALSE(is_png({}));
}

TEST(Png, RealImages) {
  AZIMUTH_REQUIRE_DATA("ceiling-tubes");
  PngDecoder decoder;
  std::ifstream stream(test::data_folder() / "ceiling-tubes" / "000000.png", std::ios::binary);
  const std::vector<char> file{std::istreambuf_iterator<char>(stream), {}};
  const ImageView image = decoder.decode(std::as_bytes(std::span(file)), PixelFormat::gray8);
  ASSERT_EQ(image.format, packed_format(PixelFormat::gray8, 640, 480)) << decoder.problem();
  EXPECT_TRUE(std::ranges::all_of(values(image), [](int each) { return each == 0 || each == 255; }));
  EXPECT_GT(std::ranges::count(image.bytes, std::byte{255}), 5000);
}

}  // namespace
}  // namespace azimuth
