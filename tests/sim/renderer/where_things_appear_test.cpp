// Objects must appear in the frame where the camera model projects them.

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <numeric>

#include "tests/sim/renderer/views.hpp"

namespace azimuth {
namespace {

using test::Change;
using test::change_between;
using test::empty_room;
using test::frame_of;
using test::NamedRenderCamera;
using test::predicted;

class WhereThingsAppear : public ::testing::TestWithParam<NamedRenderCamera> {
 protected:
  const RenderCamera& camera() const { return GetParam().camera; }
};
INSTANTIATE_TEST_SUITE_P(Cameras, WhereThingsAppear, ::testing::ValuesIn(test::render_cameras()),
                         [](const auto& each) { return each.param.name; });

RenderScene with_cylinder(const RenderCylinder& cylinder) {
  RenderScene scene = empty_room();
  scene.cylinders = {cylinder};
  return scene;
}

/// Black, so that the change of each pixel is proportional to the covered part of the pixel.
RenderCylinder black_cylinder(const Eigen::Vector2d& place) { return {place, 0.08, 0.8, 1.4, 0}; }

TEST_P(WhereThingsAppear, CylinderAtItsAzimuth) {
  const std::vector<Eigen::Vector2d> places{{2.0, 0.5}, {-1.7, 1.9}, {0.4, -3.1}, {-4.0, -4.0}, {5.5, 4.1}};
  const std::vector<Pose2> poses{{0, 0, 0}, {0.3, -0.2, 1.1}, {-0.5, 0.4, -2.9}};
  Renderer empty(empty_room(), camera());
  for (const Eigen::Vector2d& place : places) {
    Renderer renderer(with_cylinder(black_cylinder(place)), camera());
    for (const Pose2& pose : poses) {
      const Direction axis = predicted(camera(), pose, {place.x(), place.y(), 1.1});
      const Change seen = change_between(frame_of(empty, camera(), pose), frame_of(renderer, camera(), pose), camera(),
                                         axis.azimuth_rad);
      ASSERT_GT(seen.weight, 2000.0) << place.transpose();
      EXPECT_NEAR(seen.azimuth_error_px, 0.0, 0.1) << place.transpose() << " from " << pose.vector().transpose();
    }
  }
}

TEST_P(WhereThingsAppear, TurningMovesTheCylinderByTheTurn) {
  const Eigen::Vector2d place{2.5, -1.0};
  Renderer empty(empty_room(), camera()), renderer(with_cylinder(black_cylinder(place)), camera());
  for (int step = 0; step < 40; ++step) {
    const Pose2 pose{0.1, 0.2, wrap(0.003 * step)};  // less than a pixel per step
    const double azimuth = predicted(camera(), pose, {place.x(), place.y(), 1.1}).azimuth_rad;
    const Change seen =
        change_between(frame_of(empty, camera(), pose), frame_of(renderer, camera(), pose), camera(), azimuth);
    EXPECT_NEAR(seen.azimuth_error_px, 0.0, 0.1) << step;
  }
}

TEST_P(WhereThingsAppear, DrivingMovesTheCylinderAsPredicted) {
  const Eigen::Vector2d place{1.5, 1.5};
  Renderer empty(empty_room(), camera()), renderer(with_cylinder(black_cylinder(place)), camera());
  for (double x = -2.0; x < 3.0; x += 0.25) {
    const Pose2 pose{x, -0.5, 0.0};
    const double azimuth = predicted(camera(), pose, {place.x(), place.y(), 1.1}).azimuth_rad;
    const Change seen =
        change_between(frame_of(empty, camera(), pose), frame_of(renderer, camera(), pose), camera(), azimuth);
    EXPECT_NEAR(seen.azimuth_error_px, 0.0, 0.15) << x;
  }
}

/// Radial extent of an object in the image at one azimuth, in pixels, from the summed change.
double radial_extent_px(const std::vector<std::byte>& before, const std::vector<std::byte>& after,
                        const RenderCamera& camera, double azimuth_rad, double& middle_px) {
  double extent = 0.0, moment = 0.0;
  const auto bilinear = [&](const std::vector<std::byte>& frame, const Pixel& at) {
    const auto u = static_cast<std::size_t>(at.x()), v = static_cast<std::size_t>(at.y());
    const double fu = at.x() - static_cast<double>(u), fv = at.y() - static_cast<double>(v);
    const auto value = [&](std::size_t x, std::size_t y) {
      return std::to_integer<int>(frame[y * static_cast<std::size_t>(camera.width_px) + x]);
    };
    return (1 - fv) * ((1 - fu) * value(u, v) + fu * value(u + 1, v)) +
           fv * ((1 - fu) * value(u, v + 1) + fu * value(u + 1, v + 1));
  };
  constexpr double kStep_px = 0.25;
  for (double radius = camera.mask.inner_px + 3; radius < camera.mask.outer_px - 3; radius += kStep_px) {
    const Pixel at = camera.model.axes().pixel({radius, azimuth_rad});
    const double background = bilinear(before, at);
    const double part = (background - bilinear(after, at)) / background;
    extent += part * kStep_px;
    moment += part * kStep_px * radius;
  }
  middle_px = moment / extent;
  return extent;
}

TEST_P(WhereThingsAppear, CylinderFromItsFootToItsTop) {
  const Eigen::Vector2d place{2.0, 0.7};
  const RenderCylinder thick{place, 0.3, 0.8, 1.25, 0};
  const Pose2 pose{0.0, 0.0, 0.4};
  Renderer empty(empty_room(), camera()), renderer(with_cylinder(thick), camera());
  const double azimuth = predicted(camera(), pose, {place.x(), place.y(), 1.0}).azimuth_rad;
  double middle_px = 0.0;
  const double extent_px = radial_extent_px(frame_of(empty, camera(), pose), frame_of(renderer, camera(), pose),
                                            camera(), azimuth, middle_px);
  // The near side of the cylinder is visible.
  const double near_m = place.norm() - 0.3;
  const auto radius_of = [&](double height_m) {
    const Direction seen{azimuth, std::atan2(height_m - camera().height_m, near_m)};
    return camera().model.axes().polar(*camera().model.pixel(seen)).radius_px;
  };
  EXPECT_NEAR(extent_px, std::abs(radius_of(1.25) - radius_of(0.8)), 0.5);
  EXPECT_NEAR(middle_px, 0.5 * (radius_of(1.25) + radius_of(0.8)), 0.3);
}

TEST(WhereThingsAre, LampsInTheCeiling) {
  const RenderCamera camera = test::fisheye_camera();
  for (const Eigen::Vector2d& place : {Eigen::Vector2d{1.0, 2.0}, {-3.0, 0.5}, {4.0, -3.5}}) {
    RenderScene scene = empty_room();
    scene.ambient = 0.02;
    const Pose2 pose{0.2, 0.1, 0.9};
    const auto dark = frame_of(scene, camera, pose);
    scene.lamps = {{place, 0.2, 0.2}};
    const auto lit = frame_of(scene, camera, pose);
    const Direction seen = predicted(camera, pose, {place.x(), place.y(), scene.ceiling_m});
    const Change change = change_between(dark, lit, camera, seen.azimuth_rad);
    EXPECT_NEAR((change.centroid - *camera.model.pixel(seen)).norm(), 0.0, 0.3) << place.transpose();
  }
}

/// A rectangle of the ceiling in the image, computed from the camera model only.
struct Patch {
  double area_px2 = 0.0;
  Pixel centroid = Pixel::Zero();
};
Patch patch_of(const RenderLamp& lamp, const RenderCamera& camera, const Pose2& pose, double ceiling_m) {
  constexpr int kParts = 12;
  constexpr double kDifference_m = 1e-4;
  const auto pixel_of = [&](const Eigen::Vector2d& place) {
    return *camera.model.pixel(predicted(camera, pose, {place.x(), place.y(), ceiling_m}));
  };
  Patch patch;
  for (int i = 0; i < kParts; ++i)
    for (int k = 0; k < kParts; ++k) {
      const Eigen::Vector2d place = lamp.p_world_m + Eigen::Vector2d((i + 0.5) / kParts - 0.5, (k + 0.5) / kParts - 0.5)
                                                         .cwiseProduct(Eigen::Vector2d(lamp.width_m, lamp.length_m));
      const Pixel pixel = pixel_of(place);
      Eigen::Matrix2d by_place;
      by_place << pixel_of(place + Eigen::Vector2d(kDifference_m, 0.0)) - pixel,
          pixel_of(place + Eigen::Vector2d(0.0, kDifference_m)) - pixel;
      const double area_px2 = std::abs(by_place.determinant()) / (kDifference_m * kDifference_m) * lamp.width_m *
                              lamp.length_m / (kParts * kParts);
      patch.area_px2 += area_px2;
      patch.centroid += area_px2 * pixel;
    }
  patch.centroid /= patch.area_px2;
  return patch;
}

/// Lamps thinner than a pixel must neither flicker nor break into pieces.
TEST(WhereThingsAre, LampsFarAwayKeepTheirLight) {
  const RenderCamera camera = test::fisheye_camera();
  RenderScene scene;
  scene.room = {{-20.0, -20.0}, {20.0, 20.0}};
  scene.ambient = 0.0;
  Renderer without(scene, camera);
  const std::vector<std::byte> dark = frame_of(without, camera, {});
  for (int k = 0; k < 24; ++k) {
    const double azimuth_rad = 0.26 * k, distance_m = 9.0 + 0.13 * k;
    const Eigen::Vector2d place{distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad)};
    scene.lamps = {{place, 0.3, 1.2}};
    const Change seen = change_between(dark, frame_of(scene, camera, {}), camera, azimuth_rad);
    const Patch expected = patch_of(scene.lamps.front(), camera, {}, scene.ceiling_m);
    EXPECT_NEAR(seen.weight / (255.0 * expected.area_px2), 1.0, 0.1) << k;
    EXPECT_NEAR((seen.centroid - expected.centroid).norm(), 0.0, 0.2) << k;
  }
}

TEST(WhereThingsAre, PosterOnEachWall) {
  const RenderCamera camera = test::mirror_camera();
  const Pose2 pose{0.5, -0.5, 0.3};
  const std::vector<std::pair<RenderPoster, Eigen::Vector3d>> posters{
      {{Wall::east, 1.0, 1.0, 0.3, 0.3, 5}, {7.0, 1.0, 1.0}},
      {{Wall::north, 1.0, 1.0, 0.3, 0.3, 5}, {1.0, 5.0, 1.0}},
      {{Wall::west, -1.0, 1.0, 0.3, 0.3, 5}, {-6.0, -1.0, 1.0}},
      {{Wall::south, -1.0, 1.0, 0.3, 0.3, 5}, {-1.0, -5.0, 1.0}}};
  const auto bare = frame_of(empty_room(), camera, pose);
  for (const auto& [poster, place] : posters) {
    RenderScene scene = empty_room();
    scene.posters = {poster};
    const Direction seen = predicted(camera, pose, place);
    const Change change = change_between(bare, frame_of(scene, camera, pose), camera, seen.azimuth_rad);
    // The texture weights the pixels unevenly, which shifts the centroid by a few pixels at most.
    EXPECT_NEAR((change.centroid - *camera.model.pixel(seen)).norm(), 0.0, 2.0) << place.transpose();
    EXPECT_GT(change.weight, 500.0);
  }
}

TEST(WhereThingsAre, MirrorAndFisheyeAgree) {
  const Eigen::Vector2d place{1.8, -2.2};
  const Pose2 pose{-0.4, 0.6, 2.0};
  const RenderCamera mirror = test::mirror_camera(), fisheye = test::fisheye_camera();
  const auto azimuth_in = [&](const RenderCamera& camera) {
    const double roughly = predicted(camera, pose, {place.x(), place.y(), 1.1}).azimuth_rad + 0.01;
    const Change seen = change_between(frame_of(empty_room(), camera, pose),
                                       frame_of(with_cylinder(black_cylinder(place)), camera, pose), camera, roughly);
    const double radius_px = camera.model.axes().polar(seen.centroid).radius_px;
    return roughly + seen.azimuth_error_px / radius_px;
  };
  EXPECT_NEAR(wrap(azimuth_in(mirror) - azimuth_in(fisheye)), 0.0, 0.3 / 300.0);
}

TEST(WhereThingsAre, NearerCylinderHidesTheFarther) {
  const RenderCamera camera = test::mirror_camera();
  const RenderCylinder near{{1.0, 0.0}, 0.2, 0.0, 2.0, colour(0, 0, 0)}, far{{3.0, 0.0}, 0.1, 0.5, 1.2, kPaints[1]};
  for (const bool near_first : {true, false}) {
    RenderScene scene = empty_room();
    scene.cylinders = near_first ? std::vector{near, far} : std::vector{far, near};
    EXPECT_EQ(frame_of(scene, camera, {}), frame_of(with_cylinder(near), camera, {}));
  }
}

TEST(WhereThingsAre, CameraBesideTheMiddleOfTheRobot) {
  RenderCamera camera = test::mirror_camera();
  camera.T_body_camera = {0.3, -0.1, 0.5};
  const Eigen::Vector2d place{1.5, 1.0};
  const Pose2 pose{0.2, 0.3, -0.7};
  const double azimuth = predicted(camera, pose, {place.x(), place.y(), 1.1}).azimuth_rad;
  const Change seen = change_between(frame_of(empty_room(), camera, pose),
                                     frame_of(with_cylinder(black_cylinder(place)), camera, pose), camera, azimuth);
  EXPECT_NEAR(seen.azimuth_error_px, 0.0, 0.2);
}

}  // namespace
}  // namespace azimuth
