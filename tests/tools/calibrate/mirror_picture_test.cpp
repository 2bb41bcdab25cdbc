#include "tools/calibrate/mirror_picture.hpp"

#include <cairo.h>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

/// Pixels of a PNG file, 0xRRGGBB.
class Png {
 public:
  explicit Png(const std::filesystem::path& file)
      : surface_(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {}
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  unsigned at(int u, int v) const {
    unsigned word = 0;
    std::memcpy(
        &word,
        cairo_image_surface_get_data(surface_.get()) + v * cairo_image_surface_get_stride(surface_.get()) + 4 * u,
        sizeof word);
    return word & 0xffffffU;
  }

 private:
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

TEST(MirrorPicture, DrawsTheCirclesOnTheImage) {
  const FrameFormat format = packed_format(PixelFormat::rgb8, 320, 240);
  std::vector<std::byte> pixels;
  for (int i = 0; i < 320 * 240; ++i) pixels.insert(pixels.end(), {std::byte{10}, std::byte{20}, std::byte{30}});
  MirrorCircle mirror;
  mirror.rim = {{160.0, 120.0}, 100.0};
  mirror.inner = Circle{{160.0, 120.0}, 30.0};
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "picture.png";
  ASSERT_FALSE(mirror_picture({format, pixels}, mirror).write(file));

  const Png picture(file);
  ASSERT_EQ(picture.width(), 320);
  EXPECT_EQ(picture.at(310, 230), 0x0a141eU) << "the image itself, red before blue";
  EXPECT_EQ(picture.at(230, 120), 0x0a141eU) << "between the circles";
  const unsigned rim = picture.at(260, 120), disc = picture.at(190, 120);
  EXPECT_GT(rim >> 16U, 0xb0U) << "orange";
  EXPECT_LT(rim & 0xffU, 0x30U);
  EXPECT_GT(disc & 0xffU, 0xa0U) << "blue";
  EXPECT_EQ(picture.at(160, 220), rim) << "as far below the centre as to its right";
}

}  // namespace
}  // namespace azimuth
