#include <gmock/gmock.h>

#include "drivers/camera/jpeg.hpp"
#include "tests/support/png_file.hpp"
#include "tools/calibrate/image_files.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;

FileResult<ImageFile> decode(const std::string& bytes) { return decode_image(std::as_bytes(std::span(bytes)), "file"); }

std::string bytes_of(const ImageFile& image) {
  return {reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()};
}

std::string problem(const std::string& bytes) {
  const FileResult<ImageFile> image = decode(bytes);
  return image ? "none" : image.error().front().text();
}

TEST(ReadImage, TakesGreyAndColour) {
  const FileResult<ImageFile> grey = decode("P5\n3 2\n255\nabcdef");
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->format, packed_format(PixelFormat::gray8, 3, 2));
  EXPECT_EQ(bytes_of(*grey), "abcdef");
  const FileResult<ImageFile> colour = decode("P6 1 2 255 abcdef and more");
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->format, packed_format(PixelFormat::rgb8, 1, 2));
  EXPECT_EQ(bytes_of(*colour), "abcdef");
}

TEST(ReadImage, PassesOverComments) {
  const FileResult<ImageFile> image = decode("P5\n# by a camera 7 7\n2 # wide\n1\n#\n255\n# ");
  ASSERT_TRUE(image) << "only one blank lies between header and pixels";
  EXPECT_EQ(bytes_of(*image), "# ");
}

TEST(ReadImage, TakesJpeg) {
  JpegEncoder encoder;
  const std::vector<std::byte> pixels(64 * 48, std::byte{90});
  const auto jpeg = encoder.encode({packed_format(PixelFormat::gray8, 64, 48), pixels}, 90);
  const FileResult<ImageFile> image = decode_image(jpeg, "file");
  ASSERT_TRUE(image) << text(image.error());
  EXPECT_EQ(image->format, packed_format(PixelFormat::gray8, 64, 48));
  EXPECT_FALSE(decode_image(jpeg.first(jpeg.size() / 2), "file"));
}

TEST(ReadImage, TakesPng) {
  const auto png = test::PngFile(1, 1, 8, test::PngColour::rgb).pixels({0, 'a', 'b', 'c'}).end();
  const FileResult<ImageFile> image = decode_image(png, "file");
  ASSERT_TRUE(image) << text(image.error());
  EXPECT_EQ(image->format, packed_format(PixelFormat::rgb8, 1, 1));
  EXPECT_EQ(bytes_of(*image), "abc");
  EXPECT_FALSE(decode_image(std::span(png).first(png.size() / 2), "file"));
}

TEST(ReadImage, SaysWhatIsWrong) {
  EXPECT_THAT(problem(""), HasSubstr("file: is neither"));
  EXPECT_THAT(problem("P"), HasSubstr("neither"));
  EXPECT_THAT(problem("P3\n1 1\n255\n0"), HasSubstr("neither"));
  EXPECT_THAT(problem("P5"), HasSubstr("header"));
  EXPECT_THAT(problem("P5\n-3 2\n255\nabcdef"), HasSubstr("header"));
  EXPECT_THAT(problem("P5\n99999999999 2\n255\nabcdef"), HasSubstr("header"));
  EXPECT_THAT(problem("P5\n3 2\n65535\nabcdefabcdef"), HasSubstr("header"));
  EXPECT_THAT(problem("P5\n3 2\n15\nabcdef"), HasSubstr("8 bits"));
  EXPECT_THAT(problem("P5\n0 2\n255\n"), HasSubstr("no pixels"));
  EXPECT_THAT(problem("P5\n3 2\n255\nabcde"), HasSubstr("cut short"));
  EXPECT_THAT(problem("P5\n3 2\n255"), HasSubstr("cut short"));
}

TEST(ReadImage, KnowsImagesByTheirNames) {
  EXPECT_TRUE(is_image_name("a/b/000000.JPG"));
  EXPECT_TRUE(is_image_name("x.pgm"));
  EXPECT_TRUE(is_image_name("x.png"));
  EXPECT_FALSE(is_image_name("frames.csv"));
  EXPECT_FALSE(is_image_name("jpg"));
}

TEST(ReadImage, NamesAFileThatIsNotThere) {
  const FileResult<ImageFile> image = read_image("no/such.jpg");
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().front().text(), HasSubstr("no/such.jpg"));
}

}  // namespace
}  // namespace azimuth
