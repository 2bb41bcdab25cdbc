// Images of real cameras, and of ray-traced runs, in which front ends find what they look for: nothing is wrong.

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "drivers/camera/jpeg.hpp"
#include "slam/perception/image/image_watch.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/data.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

struct RealCamera {
  const char *folder, *name_begins;
  PixelPoint centre_px;
  double inner_px, outer_px;
  int every;
};
std::ostream& operator<<(std::ostream& out, const RealCamera& camera) {
  return out << camera.folder << ' ' << camera.name_begins;
}

test::Image read_jpeg(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  JpegDecoder decoder;
  const ImageView view = decoder.decode(std::as_bytes(std::span(bytes)), PixelFormat::gray8);
  return {view.format, {view.bytes.begin(), view.bytes.end()}};
}

class RealImages : public testing::TestWithParam<RealCamera> {};
INSTANTIATE_TEST_SUITE_P(Each, RealImages,
                         testing::Values(RealCamera{"mirror-images", "Kaidan", {326, 247}, 55, 222, 1},
                                         RealCamera{"mirror-images", "Mini", {364, 224}, 0, 258, 1},
                                         RealCamera{"mirror-calibration", "imgMei", {642, 521}, 55, 353, 1},
                                         RealCamera{"office-a/frames", "", {512, 384}, 60, 376, 40},
                                         RealCamera{"hall-a/frames", "", {512, 384}, 0, 376, 20}),
                         test::PrintedName());

TEST_P(RealImages, AreFineUntilTheLightIsWrong) {
  const RealCamera& camera = GetParam();
  AZIMUTH_REQUIRE_DATA(camera.folder);
  ImageRig rig;
  rig.centre_px = camera.centre_px;
  rig.mask_inner_px = camera.inner_px;
  rig.mask_outer_px = camera.outer_px;
  ImageWatch watch(rig);
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::data_folder() / camera.folder)) {
    if (!entry.path().filename().string().starts_with(camera.name_begins) || seen++ % camera.every != 0) continue;
    const test::Image image = read_jpeg(entry.path());
    ASSERT_TRUE(image.view().readable()) << entry.path();
    EXPECT_EQ(watch.judge(image.view()), ImageTrouble::none) << entry.path();
    EXPECT_EQ(watch.judge(test::scaled(image, 0.5).view()), ImageTrouble::none) << entry.path();
    EXPECT_EQ(watch.judge(test::scaled(image, 0.04).view()), ImageTrouble::dark) << entry.path();
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace azimuth
