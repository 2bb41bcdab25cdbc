#include <gtest/gtest.h>

#include "sim/renderer/renderer.hpp"

namespace azimuth {
namespace {

CameraRig mirror_rig() {
  CameraRig rig;
  rig.model = HyperbolicMirrorRig{.a_mm = 28.095, .b_mm = 23.4125, .focal_length_px = 1035.376};
  rig.image.width_px = 1024;
  rig.image.height_px = 768;
  rig.image.centre_px = {512.0, 384.0};
  rig.image.azimuth_offset_rad = -1.570796327;
  rig.image.viewpoint_height_m = 1.0;
  rig.image.mask_inner_px = 60.0;
  rig.image.mask_outer_px = 376.0;
  rig.yaw_offset_rad = 0.25;
  return rig;
}

TEST(RigCamera, MirrorIsTakenOver) {
  std::string problem;
  const auto camera = render_camera_of(mirror_rig(), problem);
  ASSERT_TRUE(camera) << problem;
  EXPECT_EQ(camera->width_px, 1024);
  EXPECT_EQ(camera->height_px, 768);
  EXPECT_EQ(camera->height_m, 1.0);
  EXPECT_EQ(camera->mask.inner_px, 60.0);
  EXPECT_EQ(camera->mask.outer_px, 376.0);
  EXPECT_EQ(camera->T_body_camera.heading_rad, 0.25);
  const auto& mirror = std::get<HyperbolicMirror>(camera->model.profile());
  EXPECT_EQ(mirror.a_mm, 28.095);
  EXPECT_EQ(mirror.focal_length_px, 1035.376);
  EXPECT_NEAR(camera->model.direction({512.0, 284.0})->azimuth_rad, 0.0, 1e-8) << "heading is up";
}

TEST(RigCamera, FisheyeIsTakenOver) {
  CameraRig rig = mirror_rig();
  rig.model = PajdlaRig{.a_px = 11892.7456, .b = 100.0, .c_px = 11892.7456, .d = 100.0};
  rig.image.theta_max_rad = 1.5;
  std::string problem;
  const auto camera = render_camera_of(rig, problem);
  ASSERT_TRUE(camera) << problem;
  EXPECT_EQ(std::get<PajdlaFisheye>(camera->model.profile()).theta_max_rad, 1.5);
}

TEST(RigCamera, SaysWhatIsMissing) {
  std::string problem;
  EXPECT_FALSE(render_camera_of(CameraRig{}, problem));
  EXPECT_FALSE(problem.empty()) << "a source of bearings has no image";
  for (const auto forget : {+[](CameraRig& rig) {
                              // The default is the middle of the image, if the size is known.
                              rig.image.centre_px.reset();
                              rig.image.width_px.reset();
                            },
                            +[](CameraRig& rig) { rig.model = HyperbolicMirrorRig{.a_mm = 28.095, .b_mm = 23.4125}; },
                            +[](CameraRig& rig) { rig.image.azimuth_direction = 0; }}) {
    CameraRig rig = mirror_rig();
    forget(rig);
    problem.clear();
    EXPECT_FALSE(render_camera_of(rig, problem));
    EXPECT_FALSE(problem.empty());
  }
}

TEST(RigCamera, WithoutASizeOrHeightThereIsNothingToRender) {
  std::string problem;
  CameraRig rig = mirror_rig();
  rig.image.viewpoint_height_m.reset();
  const auto camera = render_camera_of(rig, problem);
  ASSERT_TRUE(camera);
  RenderScene scene;
  scene.room = {{0, 0}, {5, 5}};
  EXPECT_NE(Renderer::problem(scene, *camera), std::nullopt);
}

}  // namespace
}  // namespace azimuth
