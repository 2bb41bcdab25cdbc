#include "drivers/camera/run_images.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/png_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

/// A run whose frames are grey images, each darker than the previous one.
class RunImagesTest : public testing::Test {
 protected:
  RunImagesTest() {
    run_.folder = folder_.path();
    for (int i = 0; i < 3; ++i) {
      run_.frames.push_back({stamp_from_us(i), std::to_string(i) + ".jpg"});
      write(run_.frames.back().file, jpeg_of(static_cast<std::uint8_t>(200 - 50 * i)));
    }
  }

  static std::string jpeg_of(std::uint8_t grey) {
    const FrameFormat format = packed_format(PixelFormat::gray8, 64, 48);
    const std::vector<std::byte> pixels(format.bytes(), std::byte{grey});
    JpegEncoder encoder;
    const auto jpeg = encoder.encode({format, pixels}, 90);
    return {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()};
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  void expect_refused(const std::string& reason) {
    RunImages images(run_);
    for (const ImageView& view : {images.recorded(1), images.pixels(1, PixelFormat::gray8)}) {
      EXPECT_TRUE(view.bytes.empty());
      EXPECT_NE(images.problem().find("1.jpg: " + reason), std::string::npos) << images.problem();
    }
    EXPECT_TRUE(images.pixels(2, PixelFormat::gray8).readable()) << "the next one is none the worse";
    EXPECT_EQ(images.problem(), "");
  }

  test::TemporaryFolder folder_;
  azimuth::Run run_;
};

TEST_F(RunImagesTest, ComeAsPixels) {
  RunImages images(run_);
  ASSERT_EQ(images.count(), 3u);
  for (std::size_t i : {2U, 0U, 1U}) {
    const ImageView gray = images.pixels(i, PixelFormat::gray8);
    ASSERT_EQ(gray.format, packed_format(PixelFormat::gray8, 64, 48));
    EXPECT_NEAR(gray.row(20)[30], 200 - 50 * static_cast<int>(i), 2);
    EXPECT_EQ(images.pixels(i, PixelFormat::rgb8).format, packed_format(PixelFormat::rgb8, 64, 48));
  }
}

TEST_F(RunImagesTest, ComeAsRecorded) {
  RunImages images(run_);
  const ImageView jpeg = images.recorded(0);
  EXPECT_EQ(jpeg.format, packed_format(PixelFormat::mjpeg, 64, 48));
  const std::string expected = jpeg_of(200);
  EXPECT_TRUE(std::ranges::equal(jpeg.bytes, std::as_bytes(std::span(expected))));
}

/// The content decides, not the name: some programs write PNG to "000000.jpg".
TEST_F(RunImagesTest, PngComesAsPixelsEitherWay) {
  const std::vector<std::byte> png = test::PngFile(2, 1, 8, test::PngColour::gray).pixels({0, 7, 200}).end();
  write("1.jpg", {reinterpret_cast<const char*>(png.data()), png.size()});
  RunImages images(run_);
  const ImageView recorded = images.recorded(1);
  ASSERT_EQ(recorded.format, packed_format(PixelFormat::gray8, 2, 1)) << images.problem();
  EXPECT_EQ(recorded.row(0)[1], 200);
  const ImageView colours = images.pixels(1, PixelFormat::rgb8);
  ASSERT_EQ(colours.format, packed_format(PixelFormat::rgb8, 2, 1));
  EXPECT_EQ(colours.row(0)[5], 200);
  write("1.jpg", {reinterpret_cast<const char*>(png.data()), png.size() / 2});
  expect_refused("");
}

TEST_F(RunImagesTest, MissingFile) {
  std::filesystem::remove(folder_ / "1.jpg");
  expect_refused("No such file");
}

TEST_F(RunImagesTest, EmptyFile) {
  write("1.jpg", "");
  expect_refused("is empty");
}

TEST_F(RunImagesTest, NoImageAtAll) {
  write("1.jpg", "\x89PNG, perhaps");
  expect_refused("Not a JPEG file");
}

TEST_F(RunImagesTest, CutFile) {
  write("1.jpg", jpeg_of(100).substr(0, jpeg_of(100).size() - 10));
  RunImages images(run_);
  EXPECT_TRUE(images.pixels(1, PixelFormat::gray8).bytes.empty());
  EXPECT_NE(images.problem(), "");
}

TEST_F(RunImagesTest, FolderAndPipeInPlaceOfAFile) {
  std::filesystem::remove(folder_ / "1.jpg");
  std::filesystem::create_directory(folder_ / "1.jpg");
  expect_refused("is not a regular file");
  std::filesystem::remove(folder_ / "1.jpg");
  ASSERT_EQ(::mkfifo((folder_ / "1.jpg").c_str(), 0600), 0);
  expect_refused("is not a regular file");
}

TEST_F(RunImagesTest, HugeFileIsNotRead) {
  std::filesystem::resize_file(folder_ / "1.jpg", kMaxFrameFileBytes + 1);  // a sparse file
  expect_refused("is too large");
}

}  // namespace
}  // namespace azimuth
