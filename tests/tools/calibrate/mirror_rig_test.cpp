#include "tools/calibrate/mirror_rig.hpp"

#include <gmock/gmock.h>

#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MirrorCircle mirror() {
  MirrorCircle found;
  found.rim = {{325.126, 246.5}, 223.04};
  found.inner = Circle{{325.0, 246.0}, 53.2};
  return found;
}
const FrameFormat kGrayFormat = packed_format(PixelFormat::gray8, 640, 480);

TEST(MirrorRig, IsReadBackFromItsText) {
  const FileResult<Rig> rig = read_rig(mirror_rig_text(mirror_rig(mirror(), kGrayFormat, {}), 8), "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::sift);
  EXPECT_EQ(name(rig->camera.model), "radial");
  const ImageRig& image = rig->camera.image;
  EXPECT_EQ(image.width_px, 640);
  EXPECT_EQ(image.height_px, 480);
  EXPECT_EQ(image.centre_px, (PixelPoint{325.13, 246.5}));
  EXPECT_DOUBLE_EQ(*image.mask_outer_px, 221.04);
  EXPECT_DOUBLE_EQ(*image.mask_inner_px, 55.2);
  EXPECT_EQ(rig->odometry.lambda_drift_rad2_per_m, 1e-3) << "of a robot of which nothing is known";
}

TEST(MirrorRig, HasTheHeadingUpInTheImage) {
  const Rig rig = mirror_rig(mirror(), kGrayFormat, {});
  const ImageAxes axes = axes_of(rig.camera.image);
  EXPECT_NEAR(axes.azimuth_rad(axes.centre_px - Pixel(0.0, 100.0)), 0.0, 1e-12);
  EXPECT_NEAR(axes.azimuth_rad(axes.centre_px - Pixel(100.0, 0.0)), kPi / 2, 1e-12) << "left is to the left";
}

TEST(MirrorRig, CarriesTheModelsParameters) {
  MirrorModel parabolic;
  parabolic.model = "parabolic_mirror";
  EXPECT_FALSE(read_rig(mirror_rig_text(mirror_rig(mirror(), kGrayFormat, parabolic), 1), "rig.toml"));
  parabolic.horizon_radius_px = 285.4;
  const Rig rig = mirror_rig(mirror(), kGrayFormat, parabolic);
  std::string problem;
  EXPECT_TRUE(camera_of(rig.camera, problem)) << problem;
}

TEST(MirrorRig, SaysWhatToCheck) {
  MirrorCircle without_disc = mirror();
  without_disc.inner.reset();
  const std::string bare = mirror_rig_text(mirror_rig(without_disc, kGrayFormat, {}), 1);
  EXPECT_THAT(bare, HasSubstr("from 1 image."));
  EXPECT_THAT(bare, HasSubstr("no disc was found"));
  EXPECT_THAT(bare, Not(HasSubstr("mask_inner_px =")));
  EXPECT_THAT(mirror_rig_text(mirror_rig(mirror(), kGrayFormat, {}), 8), Not(HasSubstr("no disc was found")));
}

}  // namespace
}  // namespace azimuth
