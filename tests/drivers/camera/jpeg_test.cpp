#include "drivers/camera/jpeg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <jpeglib.h>  // needs cstdio
#include <random>
#include <vector>

#include "drivers/wire/image_header.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

using Buffer = std::vector<std::byte>;

/// Smooth colours, which JPEG reproduces well: red grows with u, green with v, blue falls with both.
struct Picture {
  explicit Picture(PixelFormat pixels, int width_px = 67, int height_px = 45, int padding = 0)
      : format(packed_format(pixels, width_px, height_px)) {
    format.stride_bytes += padding;
    bytes.resize(format.bytes());
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) paint(u, v);
    }
  }

  void paint(int u, int v) {
    const int samples = bytes_per_pixel(format.pixels);
    const int red = 40 + 2 * u, green = 40 + 3 * v, blue = 230 - u - v;
    const int order[3] = {format.pixels == PixelFormat::bgr8 ? blue : red, green,
                          format.pixels == PixelFormat::bgr8 ? red : blue};
    for (int i = 0; i < samples; ++i)
      bytes[static_cast<std::size_t>(v * format.stride_bytes + u * samples + i)] = static_cast<std::byte>(order[i]);
  }

  ImageView view() const { return {format, bytes}; }

  FrameFormat format;
  Buffer bytes;
};

Buffer jpeg_of(const ImageView& image, int quality = 95) {
  JpegEncoder encoder;
  const auto file = encoder.encode(image, quality);
  return {file.begin(), file.end()};
}

int worst_difference(const ImageView& a, const ImageView& b) {
  const int row_bytes = a.format.width_px * bytes_per_pixel(a.format.pixels);
  int worst = 0;
  for (int v = 0; v < a.format.height_px; ++v) {
    for (int i = 0; i < row_bytes; ++i) worst = std::max(worst, std::abs(a.row(v)[i] - b.row(v)[i]));
  }
  return worst;
}

Buffer file_content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> chars{std::istreambuf_iterator<char>(stream), {}};
  const auto bytes = std::as_bytes(std::span(chars));
  return {bytes.begin(), bytes.end()};
}

/// Position of the two bytes of a marker in a file of the encoder.
std::size_t marker_at(const Buffer& jpeg, int marker) {
  const Buffer bytes{std::byte{0xFF}, static_cast<std::byte>(marker)};
  return static_cast<std::size_t>(std::search(jpeg.begin(), jpeg.end(), bytes.begin(), bytes.end()) - jpeg.begin());
}
constexpr int kFrameMarker = 0xC0, kTablesMarker = 0xC4;

Buffer with_size(Buffer jpeg, int width_px, int height_px) {
  const std::size_t at = marker_at(jpeg, kFrameMarker) + 5;  // after marker, length and precision
  for (std::size_t i = 0; i < 2; ++i) {
    jpeg[at + i] = static_cast<std::byte>(height_px >> (8 - 8 * i));
    jpeg[at + 2 + i] = static_cast<std::byte>(width_px >> (8 - 8 * i));
  }
  return jpeg;
}

TEST(Jpeg, HeaderSaysSizeAndColour) {
  JpegDecoder decoder;
  EXPECT_EQ(decoder.read_header(jpeg_of(Picture(PixelFormat::rgb8).view())), (JpegHeader{67, 45, true}));
  EXPECT_EQ(decoder.read_header(jpeg_of(Picture(PixelFormat::gray8, 1, 1).view())), (JpegHeader{1, 1, false}));
  EXPECT_EQ(decoder.problem(), "");
}

TEST(Jpeg, SizeIsFoundWithoutADecoder) {
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8}) {
    const Buffer jpeg = jpeg_of(Picture(pixels, 300, 17).view());
    EXPECT_EQ(jpeg_size(jpeg), (std::pair{300, 17}));
    const std::size_t header = marker_at(jpeg, kFrameMarker) + 9;
    for (std::size_t length = 0; length < header; ++length)
      EXPECT_FALSE(jpeg_size(std::span(jpeg).first(length))) << length;
  }
}

TEST(Jpeg, PixelsComeBack) {
  JpegDecoder decoder;
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8, PixelFormat::bgr8}) {
    for (const int padding : {0, 13}) {
      const Picture picture(pixels, 67, 45, padding);
      const ImageView decoded = decoder.decode(jpeg_of(picture.view()), pixels);
      ASSERT_TRUE(decoded.readable()) << decoder.problem();
      EXPECT_EQ(decoded.format, packed_format(pixels, 67, 45));
      EXPECT_LE(worst_difference(picture.view(), decoded), 6) << name(pixels);
    }
  }
}

TEST(Jpeg, QualityCostsBytes) {
  const Picture picture(PixelFormat::rgb8, 200, 150);
  EXPECT_LT(jpeg_of(picture.view(), 10).size(), jpeg_of(picture.view(), 99).size());
}

TEST(Jpeg, BrightnessOfColours) {
  const Picture picture(PixelFormat::rgb8);
  JpegDecoder decoder;
  const ImageView gray = decoder.decode(jpeg_of(picture.view(), 100), PixelFormat::gray8);
  ASSERT_TRUE(gray.readable());
  for (int v = 0; v < 45; v += 11) {
    const std::uint8_t* rgb = picture.view().row(v);
    const double luma = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
    EXPECT_NEAR(gray.row(v)[0], luma, 3.0);
  }
}

TEST(Jpeg, GreyMakesGreyColours) {
  JpegDecoder decoder;
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::gray8).view());
  ASSERT_EQ(decoder.read_header(jpeg)->natural_format(), PixelFormat::gray8);
  const ImageView rgb = decoder.decode(jpeg, PixelFormat::rgb8);
  ASSERT_TRUE(rgb.readable());
  for (int u = 0; u < 67; ++u) {
    EXPECT_EQ(rgb.row(7)[3 * u], rgb.row(7)[3 * u + 1]);
    EXPECT_EQ(rgb.row(7)[3 * u], rgb.row(7)[3 * u + 2]);
  }
}

TEST(Jpeg, DecodesIntoPaddedRowsAndNoFurther) {
  const Picture picture(PixelFormat::rgb8);
  FrameFormat format = picture.format;
  format.stride_bytes += 9;
  constexpr std::byte kUntouched{0xA5};
  Buffer pixels(format.bytes() + 100, kUntouched);
  JpegDecoder decoder;
  ASSERT_TRUE(decoder.decode_into(jpeg_of(picture.view()), format, std::span(pixels).first(format.bytes())));
  EXPECT_LE(worst_difference(picture.view(), {format, pixels}), 6);
  EXPECT_TRUE(std::all_of(pixels.end() - 109, pixels.end(), [](std::byte byte) { return byte == kUntouched; }));
}

TEST(Jpeg, RefusesWhatDoesNotFit) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8).view());
  JpegDecoder decoder;
  Buffer pixels(100'000);
  EXPECT_FALSE(decoder.decode_into(jpeg, packed_format(PixelFormat::rgb8, 67, 46), pixels));
  EXPECT_EQ(decoder.problem(), "is of another size");
  EXPECT_FALSE(decoder.decode_into(jpeg, packed_format(PixelFormat::yuyv, 68, 45), pixels));
  EXPECT_FALSE(decoder.decode_into(jpeg, packed_format(PixelFormat::mjpeg, 67, 45), pixels));
  EXPECT_FALSE(decoder.decode_into(jpeg, packed_format(PixelFormat::rgb8, 67, 45), std::span(pixels).first(67 * 45)));
  EXPECT_TRUE(decoder.decode(jpeg, PixelFormat::uyvy).bytes.empty());
  EXPECT_TRUE(decoder.decode_into(jpeg, packed_format(PixelFormat::rgb8, 67, 45), pixels));
  JpegEncoder encoder;
  const Picture picture(PixelFormat::rgb8);
  EXPECT_TRUE(encoder.encode({picture.format, std::span(picture.bytes).first(100)}, 90).empty());
  EXPECT_TRUE(encoder.encode({packed_format(PixelFormat::yuyv, 64, 45), picture.bytes}, 90).empty());
  EXPECT_TRUE(encoder.encode(picture.view(), 0).empty());
  EXPECT_TRUE(encoder.encode(picture.view(), 101).empty());
}

TEST(Jpeg, CutAnywhereIsRefusedUnlessAllPixelsAreThere) {
  JpegDecoder decoder, other;
  for (const PixelFormat pixels : {PixelFormat::gray8, PixelFormat::rgb8}) {
    const Buffer jpeg = jpeg_of(Picture(pixels).view());
    const ImageView whole = other.decode(jpeg, pixels);
    for (std::size_t length = 0; length < jpeg.size(); ++length) {
      const ImageView cut = decoder.decode(std::span(jpeg).first(length), pixels);
      if (length < jpeg.size() - 3) {  // the end marker, and one byte that holds at least a bit of the last pixels
        EXPECT_TRUE(cut.bytes.empty()) << length << '/' << jpeg.size();
        EXPECT_FALSE(decoder.problem().empty());
      } else if (!cut.bytes.empty()) {
        EXPECT_EQ(worst_difference(whole, cut), 0) << length << '/' << jpeg.size();
      }
    }
    EXPECT_FALSE(decoder.decode(jpeg, pixels).bytes.empty()) << "unharmed by what it refused";
  }
}

/// Encoding options of cameras: a restart marker after some rows of blocks, and chroma subsampling.
struct CameraHabits {
  int rows_to_restart = 0;
  int across = 1, down = 1;  // luma samples per chroma sample
};
Buffer jpeg_of(const Picture& picture, const CameraHabits& habits) {
  jpeg_compress_struct compress{};
  jpeg_error_mgr errors{};
  compress.err = jpeg_std_error(&errors);
  jpeg_create_compress(&compress);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&compress, &bytes, &size);
  compress.image_width = static_cast<JDIMENSION>(picture.format.width_px);
  compress.image_height = static_cast<JDIMENSION>(picture.format.height_px);
  compress.input_components = 3;
  compress.in_color_space = JCS_RGB;
  jpeg_set_defaults(&compress);
  jpeg_set_quality(&compress, 95, TRUE);
  compress.restart_in_rows = habits.rows_to_restart;
  compress.comp_info[0].h_samp_factor = habits.across;
  compress.comp_info[0].v_samp_factor = habits.down;
  jpeg_start_compress(&compress, TRUE);
  while (compress.next_scanline < compress.image_height) {
    auto* row = const_cast<unsigned char*>(picture.view().row(static_cast<int>(compress.next_scanline)));
    jpeg_write_scanlines(&compress, &row, 1);
  }
  jpeg_finish_compress(&compress);
  jpeg_destroy_compress(&compress);
  const auto made = std::as_bytes(std::span(bytes, size));
  Buffer jpeg(made.begin(), made.end());
  std::free(bytes);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg's
  return jpeg;
}

/// Inserts bytes before each restart marker and before the end marker.
Buffer padded(const Buffer& jpeg, std::size_t count, std::byte value) {
  Buffer out;
  for (std::size_t i = 0; i < jpeg.size(); ++i) {
    const bool is_marker = i + 1 < jpeg.size() && jpeg[i] == std::byte{0xFF} && jpeg[i + 1] >= std::byte{0xD0} &&
                           jpeg[i + 1] <= std::byte{0xD9} && jpeg[i + 1] != std::byte{0xD8};
    if (is_marker) out.insert(out.end(), count, value);
    out.push_back(jpeg[i]);
  }
  return out;
}

TEST(Jpeg, PaddingBeforeMarkersCostsNoPixel) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8), {.rows_to_restart = 1, .across = 2});
  JpegDecoder decoder, other;
  const ImageView whole = other.decode(jpeg, PixelFormat::rgb8);
  ASSERT_TRUE(whole.readable());
  for (const std::size_t count : {1, 2, 9}) {
    for (const std::byte value : {std::byte{0}, std::byte{0x55}, std::byte{0xFF}}) {
      const ImageView image = decoder.decode(padded(jpeg, count, value), PixelFormat::rgb8);
      ASSERT_TRUE(image.readable()) << count << ' ' << decoder.problem();
      EXPECT_EQ(worst_difference(whole, image), 0) << count;
    }
  }
  EXPECT_TRUE(decoder.decode(padded(jpeg, 40, std::byte{0x55}), PixelFormat::rgb8).bytes.empty());
  EXPECT_NE(decoder.problem().find("40 extraneous bytes"), std::string::npos) << decoder.problem();
}

TEST(Jpeg, RowsThatAreMissingOrCutAreRefusedThoughTheEndIsThere) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8), {.rows_to_restart = 1});
  const auto first = static_cast<std::ptrdiff_t>(marker_at(jpeg, 0xD0)),
             second = static_cast<std::ptrdiff_t>(marker_at(jpeg, 0xD1));
  ASSERT_GT(second, first + 40);
  JpegDecoder decoder;
  Buffer missing = jpeg, shorter = jpeg;
  missing.erase(missing.begin() + first, missing.begin() + second);
  EXPECT_FALSE(decoder.decode(missing, PixelFormat::rgb8).readable());
  shorter.erase(shorter.begin() + first + 10, shorter.begin() + first + 30);
  EXPECT_FALSE(decoder.decode(shorter, PixelFormat::rgb8).readable());
}

TEST(Jpeg, CutImageFilledUpWithZerosIsRefused) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8, 200, 150), {.rows_to_restart = 0});
  JpegDecoder decoder;
  for (std::size_t length = jpeg.size() / 4; length + 40 < jpeg.size(); length += 37) {
    Buffer filled(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(length));
    filled.resize(jpeg.size() + 4096);
    EXPECT_FALSE(decoder.decode(filled, PixelFormat::rgb8).readable()) << length;
    filled.insert(filled.end(), {std::byte{0xFF}, std::byte{0xD9}});
    EXPECT_FALSE(decoder.decode(filled, PixelFormat::rgb8).readable()) << length;
  }
}

TEST(Jpeg, StartTwiceAndBytesBetweenHeadersCostNoPixel) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8).view());
  JpegDecoder decoder, other;
  const ImageView whole = other.decode(jpeg, PixelFormat::rgb8);
  Buffer twice = jpeg, between = jpeg;
  twice.insert(twice.begin(), {std::byte{0xFF}, std::byte{0xD8}});
  between.insert(between.begin() + static_cast<std::ptrdiff_t>(marker_at(jpeg, 0xDB)), 608, std::byte{0x20});
  for (const Buffer& each : {twice, between}) {
    const ImageView image = decoder.decode(each, PixelFormat::rgb8);
    ASSERT_TRUE(image.readable()) << decoder.problem();
    EXPECT_EQ(worst_difference(whole, image), 0);
    EXPECT_EQ(jpeg_size(each), (std::pair{67, 45}));
  }
}

TEST(Jpeg, ColoursMayBeSampledInAnyWay) {
  const Picture picture(PixelFormat::rgb8);
  JpegDecoder decoder;
  for (const auto& [across, down] : {std::pair{4, 1}, {1, 2}, {2, 2}, {1, 4}, {4, 2}, {2, 1}}) {
    const ImageView image = decoder.decode(jpeg_of(picture, {.across = across, .down = down}), PixelFormat::rgb8);
    ASSERT_TRUE(image.readable()) << across << 'x' << down << ' ' << decoder.problem();
    EXPECT_LE(worst_difference(picture.view(), image), 14) << across << 'x' << down;
  }
}

TEST(Jpeg, BytesAfterTheEndDoNoHarm) {
  const Buffer whole = jpeg_of(Picture(PixelFormat::rgb8).view());
  JpegDecoder decoder;
  Buffer jpeg = whole;
  jpeg.resize(jpeg.size() + 5000);  // the driver's buffer is larger than the image
  EXPECT_TRUE(decoder.decode(jpeg, PixelFormat::rgb8).readable());
  jpeg = whole;
  jpeg.insert(jpeg.end(), whole.begin(), whole.begin() + 300);  // and still contains parts of an earlier image
  EXPECT_TRUE(decoder.decode(jpeg, PixelFormat::rgb8).readable()) << decoder.problem();
}

TEST(Jpeg, CamerasLeaveTheEndMarkerOut) {
  const Buffer whole = jpeg_of(Picture(PixelFormat::rgb8).view());
  JpegDecoder decoder, other;
  const ImageView image = decoder.decode(std::span(whole).first(whole.size() - 2), PixelFormat::rgb8);
  ASSERT_TRUE(image.readable()) << decoder.problem();
  EXPECT_EQ(worst_difference(other.decode(whole, PixelFormat::rgb8), image), 0);
}

TEST(Jpeg, CamerasLeaveTheStandardTablesOut) {
  const Buffer whole = jpeg_of(Picture(PixelFormat::rgb8).view());
  Buffer without = whole;
  for (std::size_t at = marker_at(without, kTablesMarker); at < without.size();
       at = marker_at(without, kTablesMarker)) {
    const auto length =
        2 + 256 * std::to_integer<std::ptrdiff_t>(without[at + 2]) + std::to_integer<std::ptrdiff_t>(without[at + 3]);
    const auto begin = without.begin() + static_cast<std::ptrdiff_t>(at);
    without.erase(begin, begin + length);
  }
  ASSERT_LT(without.size(), whole.size());
  JpegDecoder decoder, other;
  const ImageView a = decoder.decode(whole, PixelFormat::rgb8), b = other.decode(without, PixelFormat::rgb8);
  ASSERT_TRUE(b.readable()) << other.problem();
  EXPECT_EQ(worst_difference(a, b), 0);
}

TEST(Jpeg, HeaderThatClaimsTooMuchIsRefused) {
  const Buffer jpeg = jpeg_of(Picture(PixelFormat::rgb8).view());
  JpegDecoder decoder;
  EXPECT_TRUE(decoder.read_header(with_size(jpeg, 8192, 4096)));
  EXPECT_FALSE(decoder.read_header(with_size(jpeg, 8192, 4097)));
  EXPECT_FALSE(decoder.read_header(with_size(jpeg, 65500, 1)));
  EXPECT_FALSE(decoder.read_header(with_size(jpeg, 0, 45)));
  EXPECT_TRUE(decoder.decode(with_size(jpeg, 67, 90), PixelFormat::rgb8).bytes.empty()) << "half of it is missing";
}

TEST(Jpeg, AnyBytesAreSafe) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same every time
  const Buffer good[] = {jpeg_of(Picture(PixelFormat::rgb8).view()), jpeg_of(Picture(PixelFormat::gray8).view())};
  JpegDecoder decoder;
  int accepted = 0;
  for (int i = 0; i < 5000; ++i) {
    Buffer jpeg = good[random() % 2];
    for (std::uint64_t changes = random() % 3; changes > 0; --changes)
      jpeg[random() % jpeg.size()] = static_cast<std::byte>(random());
    jpeg_size(jpeg);
    const auto header = decoder.read_header(jpeg);
    if (!header || header->width_px > 100'000 / header->height_px) continue;
    const ImageView image = decoder.decode(jpeg, PixelFormat::rgb8);
    accepted += image.readable() ? 1 : 0;
  }
  EXPECT_GT(accepted, 1000) << "the mutations leave nothing to accept";
  EXPECT_LT(accepted, 4900);
  Buffer noise(3000);
  for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
  EXPECT_FALSE(decoder.read_header(noise));
}

TEST(Jpeg, StorageIsKept) {
  const Picture large(PixelFormat::rgb8, 160, 120), small(PixelFormat::rgb8, 80, 60);
  const Buffer large_jpeg = jpeg_of(large.view()), small_jpeg = jpeg_of(small.view());
  JpegDecoder decoder;
  const std::byte* pixels = decoder.decode(large_jpeg, PixelFormat::rgb8).bytes.data();
  JpegEncoder encoder;
  const std::byte* file = encoder.encode(large.view(), 90).data();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(decoder.decode(i % 2 == 0 ? small_jpeg : large_jpeg, PixelFormat::rgb8).bytes.data(), pixels);
    EXPECT_EQ(encoder.encode(i % 2 == 0 ? small.view() : large.view(), 90).data(), file);
  }
}

TEST(Jpeg, RealImages) {
  AZIMUTH_REQUIRE_DATA("mirror-images");
  JpegDecoder decoder;
  int images = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::data_folder() / "mirror-images")) {
    if (entry.path().extension() != ".jpg") continue;
    const Buffer jpeg = file_content(entry.path());
    EXPECT_TRUE(decoder.decode(jpeg, PixelFormat::rgb8).readable()) << entry.path() << ' ' << decoder.problem();
    const JpegHeader header = decoder.read_header(jpeg).value_or(JpegHeader{});
    EXPECT_EQ(jpeg_size(jpeg), std::pair(header.width_px, header.height_px)) << entry.path();
    ++images;
  }
  EXPECT_GT(images, 0);
}

}  // namespace
}  // namespace azimuth
