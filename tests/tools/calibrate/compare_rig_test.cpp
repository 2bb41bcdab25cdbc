#include <cmath>
#include <gmock/gmock.h>

#include "slam/camera/make_camera.hpp"
#include "tools/calibrate/mirror_rig.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;

MirrorCircle mirror_at(double u, double v) {
  MirrorCircle mirror;
  mirror.rim = {{u, v}, 200.0};
  mirror.sigma_centre_px = 0.1;
  return mirror;
}

ImageRig rig_at(double u, double v) {
  ImageRig rig;
  rig.centre_px = {u, v};
  return rig;
}

TEST(CompareCentre, AgreesWithinThreePixels) {
  EXPECT_TRUE(compare_centre(mirror_at(320, 240), rig_at(322, 242)).agrees);
  EXPECT_FALSE(compare_centre(mirror_at(320, 240), rig_at(323, 243)).agrees);
  MirrorCircle vague = mirror_at(320, 240);
  vague.sigma_centre_px = 1.0;
  EXPECT_TRUE(compare_centre(vague, rig_at(323, 243)).agrees) << "the images do not say otherwise";
}

TEST(CompareCentre, KnowsTheWorstBearing) {
  const CentreComparison off = compare_centre(mirror_at(320, 240), rig_at(330, 240));
  EXPECT_DOUBLE_EQ(off.off_px, 10.0);
  // The worst error of bearings on a ring at half the radius of the rim, read with the wrong centre.
  const ImageAxes right{{320, 240}}, wrong{{330, 240}};
  double worst_rad = 0.0;
  for (int i = 0; i < 3600; ++i) {
    const Pixel pixel = right.pixel({100.0, -kPi + i * kPi / 1800});
    worst_rad = std::max(worst_rad, std::abs(wrap(wrong.azimuth_rad(pixel) - right.azimuth_rad(pixel))));
  }
  EXPECT_NEAR(off.worst_azimuth_rad, worst_rad, 1e-6);
  EXPECT_THAT(text(off, "rig.toml"), HasSubstr("rig.toml: its centre is 10.0 px off"));
  EXPECT_THAT(text(off, "rig.toml"), HasSubstr("5.7 deg: calibrate anew"));
}

TEST(CompareCentre, MeasuresInPixelsOfTheImage) {
  ImageRig rig = rig_at(320, 200);
  rig.beta = 1.2;  // pixels higher than wide
  EXPECT_NEAR(compare_centre(mirror_at(320, 240), rig).off_px, 0.0, 1e-9);
}

}  // namespace
}  // namespace azimuth
