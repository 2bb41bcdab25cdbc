#include "sim/renderer/renderer.hpp"

#include <gmock/gmock.h>

#include "tests/sim/renderer/views.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using test::empty_room;
using test::frame_of;
using test::mirror_camera;

RenderCamera noisy_mirror() {
  RenderCamera camera = mirror_camera();
  camera.sensor = {2.0, 0.3, 376.0, 11};
  return camera;
}

TEST(Renderer, SameSeedSameFrames) {
  const RenderScene scene = coloured_scene(lab(4, 1));
  Renderer one(scene, noisy_mirror()), other(scene, noisy_mirror());
  for (int i = 0; i < 4; ++i) {
    const Pose2 pose{3.0 + 0.3 * i, 2.2, 0.1 * i};
    EXPECT_EQ(frame_of(one, noisy_mirror(), pose, PixelFormat::rgb8),
              frame_of(other, noisy_mirror(), pose, PixelFormat::rgb8));
  }
}

TEST(Renderer, FramesDependOnWorldPoseAndNothingBefore) {
  const RenderScene scene = coloured_scene(lab(4, 1));
  Renderer renderer(scene, mirror_camera());
  const auto first = frame_of(renderer, mirror_camera(), {3.0, 2.2, 0.5});
  const auto elsewhere = frame_of(renderer, mirror_camera(), {8.0, 5.0, -1.0});
  EXPECT_NE(first, elsewhere);
  EXPECT_EQ(frame_of(renderer, mirror_camera(), {3.0, 2.2, 0.5}), first);
  EXPECT_NE(frame_of(coloured_scene(lab(5, 1)), mirror_camera(), {3.0, 2.2, 0.5}), first);
}

TEST(Renderer, StepByStepIsTheSameFrame) {
  const RenderScene scene = coloured_scene(lab(4, 1));
  Renderer at_once(scene, noisy_mirror()), in_steps(scene, noisy_mirror());
  const FrameFormat format = packed_format(PixelFormat::gray8, 1024, 768);
  std::vector<std::byte> bytes(format.bytes());
  for (const Pose2 pose : {Pose2{3.0, 2.2, 0.5}, Pose2{8.0, 5.0, -1.0}}) {
    in_steps.begin(pose);
    int steps = 1;
    while (!in_steps.step({format, bytes})) ++steps;
    EXPECT_GT(steps, 20);
    EXPECT_TRUE(in_steps.step({format, bytes})) << "whole it stays";
    EXPECT_EQ(bytes, frame_of(at_once, noisy_mirror(), pose));
  }
}

TEST(Renderer, FrameBegunAnewForgetsTheOne) {
  Renderer renderer(coloured_scene(lab(4, 1)), mirror_camera());
  const FrameFormat format = packed_format(PixelFormat::gray8, 1024, 768);
  std::vector<std::byte> bytes(format.bytes());
  const auto expected = frame_of(renderer, mirror_camera(), {3.0, 2.2, 0.5});
  renderer.begin({8.0, 5.0, -1.0});
  for (int i = 0; i < 25; ++i) renderer.step({format, bytes});
  EXPECT_EQ(frame_of(renderer, mirror_camera(), {3.0, 2.2, 0.5}), expected);
}

TEST(Renderer, MaskIsBlackAndTheRestIsNot) {
  RenderCamera camera = mirror_camera();
  camera.mask.hidden = {{{700, 380}, {900, 380}, {900, 388}, {700, 388}}};
  const ImageMask mask(camera.model.axes(), camera.mask);
  RenderScene scene = empty_room();
  const auto frame = frame_of(scene, camera, {0.3, 0.2, 0.7});
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const int value = std::to_integer<int>(frame[static_cast<std::size_t>(v * camera.width_px + u)]);
      ASSERT_EQ(value < 10, !mask.visible({u, v})) << u << ' ' << v;
    }
  }
}

TEST(Renderer, HeadingTurnsTheImageAboutItsCentre) {
  // A quarter turn maps the pixel grid onto itself, so the frames agree pixel by pixel except for rounding.
  const RenderCamera camera = mirror_camera();
  Renderer renderer(coloured_scene(lab(1, 1)), camera);
  const auto straight = frame_of(renderer, camera, {4.0, 3.0, 0.2});
  const auto turned = frame_of(renderer, camera, {4.0, 3.0, 0.2 + kPi / 2});
  const auto at = [&](const std::vector<std::byte>& frame, int u, int v) {
    return std::to_integer<int>(frame[static_cast<std::size_t>(v * camera.width_px + u)]);
  };
  int different = 0, compared = 0;
  for (int dv = -370; dv <= 370; ++dv) {
    for (int du = -370; du <= 370; ++du, ++compared) {
      // The heading is up in the image and azimuth grows to the left: after a left turn, objects ahead appear to the
      // right.
      different += std::abs(at(straight, 512 + du, 384 + dv) - at(turned, 512 - dv, 384 + du)) > 12 ? 1 : 0;
    }
  }
  EXPECT_LT(different, compared / 200);
}

TEST(Renderer, LookingExactlyAlongAWallIsNothingSpecial) {
  // With heading 0, the pixels straight ahead of the centre look exactly along the x axis.
  const RenderCamera camera = mirror_camera();
  Renderer renderer(empty_room(), camera);
  const auto along = frame_of(renderer, camera, {1.0, 0.5, 0.0}), beside = frame_of(renderer, camera, {1.0, 0.5, 1e-6});
  for (std::size_t v = 10; v < 320; ++v) {
    const std::size_t i = v * 1024 + 512;
    ASSERT_NEAR(std::to_integer<int>(along[i]), std::to_integer<int>(beside[i]), 12) << "row " << v;
  }
}

TEST(Renderer, BeyondAWallSeesWhatIsJustInside) {
  Renderer renderer(empty_room(), mirror_camera());
  EXPECT_EQ(frame_of(renderer, mirror_camera(), {100.0, 1.0, 0.0}),
            frame_of(renderer, mirror_camera(), {7.0, 1.0, 0.0}));
}

TEST(Renderer, WritesOnlyWhatItCan) {
  const Renderer renderer(empty_room(), mirror_camera());
  EXPECT_TRUE(renderer.can_write(packed_format(PixelFormat::yuyv, 1024, 768)));
  EXPECT_TRUE(renderer.can_write({PixelFormat::gray8, 1024, 768, 1100}));
  EXPECT_FALSE(renderer.can_write(packed_format(PixelFormat::mjpeg, 1024, 768)));
  EXPECT_FALSE(renderer.can_write(packed_format(PixelFormat::bayer_rggb8, 1024, 768)));
  EXPECT_FALSE(renderer.can_write(packed_format(PixelFormat::gray8, 640, 480)));
}

TEST(Renderer, SaysWhatItCannotRender) {
  EXPECT_EQ(Renderer::problem(empty_room(), mirror_camera()), std::nullopt);
  RenderCamera high = mirror_camera(), sizeless = mirror_camera();
  high.height_m = 3.0;
  sizeless.width_px = 0;
  EXPECT_NE(Renderer::problem(empty_room(), high), std::nullopt);
  EXPECT_NE(Renderer::problem(empty_room(), sizeless), std::nullopt);
  RenderScene flat = empty_room();
  flat.room.high_m.x() = flat.room.low_m.x();
  EXPECT_NE(Renderer::problem(flat, mirror_camera()), std::nullopt);
}

TEST(Renderer, AllocatesNothingPerFrame) {
  const RenderCamera camera = noisy_mirror();
  Renderer renderer(coloured_scene(lab(1, 1)), camera);
  const FrameFormat format = packed_format(PixelFormat::yuyv, 1024, 768);
  std::vector<std::byte> bytes(format.bytes());
  const std::size_t before = allocations();
  for (int i = 0; i < 3; ++i) renderer.render({4.0 + i, 3.0, 0.5 * i}, {format, bytes});
  EXPECT_EQ(allocations() - before, 0U);
}

/// Poses inside a landmark, in a corner or along a wall must also produce a frame.
TEST(Renderer, AnyPoseHasAFrame) {
  const Scenario scenario = lab(2, 1);
  RenderCamera camera = mirror_camera();
  Renderer renderer(coloured_scene(scenario), camera);
  for (const WorldLandmark& landmark : scenario.landmarks) {
    for (const double beside_m : {0.0, 0.0149, 0.02, 0.076, 0.09, 0.11}) {
      const Eigen::Vector2d& place = landmark.p_world_landmark_m;
      ASSERT_FALSE(frame_of(renderer, camera, {place.x() + beside_m, place.y(), 0.0}).empty());
    }
    camera.width_px = 1024;
    if (landmark.identity > 2) break;
  }
}

}  // namespace
}  // namespace azimuth
