#include "sim/renderer/standard_cameras.hpp"

#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "sim/renderer/renderer.hpp"

namespace azimuth {
namespace {

class StandardCamera : public ::testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Cameras, StandardCamera, ::testing::ValuesIn(kStandardCameras),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(StandardCamera, CanBeRendered) {
  std::string problem;
  const auto camera = render_camera_of(*standard_camera(GetParam()), problem);
  ASSERT_TRUE(camera) << problem;
  EXPECT_EQ(Renderer::problem(lamp_scene(hall(1), 6.5), *camera), std::nullopt);
}

TEST_P(StandardCamera, ComesBackFromRigToml) {
  const CameraRig rig = *standard_camera(GetParam());
  const FileResult<Rig> read = read_rig(image_camera_toml(rig), "rig.toml");
  ASSERT_TRUE(read) << text(read.error());
  const CameraRig& again = read->camera;
  EXPECT_EQ(read->front_end, GetParam() == "mirror" ? FrontEnd::colour : FrontEnd::lamps);
  EXPECT_TRUE(again.model == rig.model);
  EXPECT_EQ(again.image.width_px, rig.image.width_px);
  EXPECT_EQ(again.image.height_px, rig.image.height_px);
  EXPECT_EQ(again.image.centre_px, rig.image.centre_px);
  EXPECT_EQ(again.image.azimuth_direction, rig.image.azimuth_direction);
  EXPECT_EQ(again.image.azimuth_offset_rad, rig.image.azimuth_offset_rad);
  EXPECT_EQ(again.image.viewpoint_height_m, rig.image.viewpoint_height_m);
  EXPECT_EQ(again.image.mask_inner_px, rig.image.mask_inner_px);
  EXPECT_EQ(again.image.mask_outer_px, rig.image.mask_outer_px);
  EXPECT_EQ(again.image.theta_max_rad, rig.image.theta_max_rad);
}

TEST_P(StandardCamera, SeesTheSameWhenScaled) {
  std::string problem;
  const CameraRig rig = *standard_camera(GetParam()), half = scaled(rig, 0.5);
  EXPECT_EQ(half.image.width_px, 512);
  EXPECT_EQ(half.image.height_px, 384);
  const auto whole_camera = render_camera_of(rig, problem), half_camera = render_camera_of(half, problem);
  ASSERT_TRUE(whole_camera && half_camera) << problem;
  for (const double azimuth_rad : {-2.0, 0.1, 1.5}) {
    const Eigen::Vector3d direction(std::cos(azimuth_rad), std::sin(azimuth_rad), GetParam() == "mirror" ? -0.3 : 0.8);
    const auto pixel = whole_camera->model.pixel(direction), half_pixel = half_camera->model.pixel(direction);
    ASSERT_TRUE(pixel && half_pixel);
    // The same point of the image, measured from the image's corner.
    EXPECT_NEAR(half_pixel->x() + 0.5, (pixel->x() + 0.5) / 2.0, 1e-6);
    EXPECT_NEAR(half_pixel->y() + 0.5, (pixel->y() + 0.5) / 2.0, 1e-6);
  }
}

TEST(StandardCameras, OthersAreUnknown) { EXPECT_FALSE(standard_camera("pinhole")); }

}  // namespace
}  // namespace azimuth
