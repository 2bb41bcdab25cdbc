// Images of real cameras and of ray-traced runs, all usable: the watch must not report any trouble.

#include <gtest/gtest.h>

#include "slam/perception/image/image_watch.hpp"
#include "tests/perception/image/camera_images.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

struct RealCamera {
  test::CameraImages images;
  std::size_t every;
};
std::ostream& operator<<(std::ostream& out, const RealCamera& camera) { return out << camera.images; }

class RealImages : public testing::TestWithParam<RealCamera> {};
INSTANTIATE_TEST_SUITE_P(Each, RealImages,
                         testing::Values(RealCamera{{"mirror-images", "Kaidan", {326, 247}, 55, 222}, 1},
                                         RealCamera{{"mirror-images", "Mini", {364, 224}, 0, 258}, 1},
                                         RealCamera{{"mirror-calibration", "imgMei", {642, 521}, 55, 353}, 1},
                                         RealCamera{{"office-a/frames", "", {512, 384}, 60, 376}, 40},
                                         RealCamera{{"hall-a/frames", "", {512, 384}, 0, 376}, 20}),
                         test::PrintedName());

TEST_P(RealImages, AreFineUntilTheLightIsWrong) {
  const RealCamera& camera = GetParam();
  AZIMUTH_REQUIRE_DATA(camera.images.folder);
  ImageWatch watch(camera.images.rig());
  const std::vector<std::filesystem::path> files = camera.images.files();
  for (std::size_t i = 0; i < files.size(); i += camera.every) {
    const test::Image image = test::read_image(files[i]);
    ASSERT_TRUE(image.view().readable()) << files[i];
    EXPECT_EQ(watch.judge(image.view()), ImageTrouble::none) << files[i];
    EXPECT_EQ(watch.judge(test::scaled(image, 0.5).view()), ImageTrouble::none) << files[i];
    EXPECT_EQ(watch.judge(test::scaled(image, 0.04).view()), ImageTrouble::dark) << files[i];
  }
  EXPECT_FALSE(files.empty());
}

}  // namespace
}  // namespace azimuth
