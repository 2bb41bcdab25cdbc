// Lamps of a rendered hall must be found at their true directions, in every format, with both inverse camera models.

#include "slam/perception/lamps/lamp_perception.hpp"

#include <gtest/gtest.h>
#include <random>

#include "slam/camera/make_camera.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/perception/lamps/lamp_views.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

constexpr double kCeiling_m = 6.5;

CameraRig rig() {
  CameraRig rig;
  rig.model = EquidistantRig{.focal_length_px = 200.0};
  rig.image.width_px = 1024;
  rig.image.height_px = 768;
  rig.image.centre_px = {512.0, 384.0};
  rig.image.azimuth_offset_rad = -kPi / 2;
  rig.image.theta_max_rad = 1.92;
  rig.image.mask_outer_px = 384.0;
  return rig;
}

struct View {
  test::Image image;
  std::vector<Direction> lamps;  ///< lamps large enough to be found reliably
};

/// Lamps have sides of 0.3 m and 1.2 m. If a lamp reaches through a wall or into another lamp, its visible centre is
/// unknown.
bool stands_alone(const RenderLamp& lamp, const RenderScene& scene) {
  const Eigen::Vector2d half{0.15, 0.6}, low = lamp.p_world_m - half, high = lamp.p_world_m + half;
  if ((low.array() < scene.room.low_m.array()).any() || (high.array() > scene.room.high_m.array()).any()) return false;
  return std::ranges::count_if(scene.lamps, [&lamp](const RenderLamp& other) {
           return (other.p_world_m - lamp.p_world_m).norm() < 1.5;
         }) == 1;
}

View view_from(const Pose2& T_world_body, double above_rad = 0.4, const CameraTilt& tilt = {}) {
  const RenderScene scene = lamp_scene(hall(1, 1), kCeiling_m);
  RenderCamera camera = test::fisheye_camera();
  camera.model = CameraModel(camera.model.axes(), camera.model.profile(), tilt);
  View view{test::rendered(scene, camera, T_world_body), {}};
  for (const RenderLamp& lamp : scene.lamps) {
    const Eigen::Vector3d p_world(lamp.p_world_m.x(), lamp.p_world_m.y(), kCeiling_m);
    const Direction direction = test::direction_to(T_world_body, camera.height_m, p_world);
    if (direction.elevation_rad > above_rad && stands_alone(lamp, scene)) view.lamps.push_back(direction);
  }
  return view;
}

/// A pose whose heading is not along the lamps' sides: the renderer's outlines are sharp and would jump by whole
/// pixels.
Pose2 place_of(int k) {
  const Eigen::Vector2d middle = hall(1, 1).landmarks.front().p_world_landmark_m;
  return {middle.x() + 0.6 + 1.3 * k, middle.y() + 0.9 + 0.7 * k, 0.3 + 0.9 * k};
}

const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    std::vector<View> some;
    for (int k = 0; k < 6; ++k) some.push_back(view_from(place_of(k)));
    return some;
  }();
  return all;
}

test::LampScore score(const LampSettings& settings) {
  LampPerception perception(rig(), settings);
  BearingSet seen;
  test::LampScore score;
  for (const View& view : views()) {
    perception.observe(view.image.view(), seen);
    EXPECT_EQ(seen.trouble, ImageTrouble::none);
    score.add(view.lamps, seen.bearings);
  }
  return score;
}

TEST(LampPerception, FindsEveryLampAsWellAsItSays) {
  const test::LampScore found = score({});
  EXPECT_EQ(found.found, found.expected);
  EXPECT_GT(found.expected, 40);
  EXPECT_LT(found.azimuth_rms(), 1.2);
  EXPECT_LT(found.elevation_rms(), 1.2);
  EXPECT_GT(found.azimuth_rms(), 0.1);
  EXPECT_GT(found.elevation_rms(), 0.1);
  EXPECT_LT(found.worst, 4.0);
}

/// Lamps at the far end of the hall are thinner than a pixel, so the threshold cuts them into pieces.
TEST(LampPerception, KnowsThatThinLampsAreCut) {
  LampPerception perception(rig(), {});
  BearingSet seen;
  test::LampScore far;
  for (int k = 0; k < 12; ++k) {
    const View view = view_from({9.0 + 0.57 * k, 14.0 - 0.43 * k, 0.5 * k}, 0.2);
    perception.observe(view.image.view(), seen);
    far.add(view.lamps, seen.bearings);
  }
  EXPECT_GT(far.found, 150);
  EXPECT_LT(far.azimuth_rms(), 1.2);
  EXPECT_LT(far.elevation_rms(), 1.2);
  EXPECT_LT(far.worst, 8.0);
}

TEST(LampPerception, OfALensThatLeansPutsLampsWhereTheyAre) {
  const CameraTilt tilt{.roll_rad = 0.06, .pitch_rad = -0.1};
  CameraRig leaning = rig();
  leaning.roll_rad = tilt.roll_rad;
  leaning.pitch_rad = tilt.pitch_rad;
  LampPerception perception(leaning, {});
  BearingSet seen;
  test::LampScore score;
  for (int k = 0; k < 6; ++k) {
    const View view = view_from(place_of(k), 0.5, tilt);
    perception.observe(view.image.view(), seen);
    score.add(view.lamps, seen.bearings);
  }
  EXPECT_EQ(score.found, score.expected);
  EXPECT_GT(score.expected, 25);
  EXPECT_LT(score.azimuth_rms(), 1.2);
  EXPECT_LT(score.elevation_rms(), 1.2);
}

TEST(LampPerception, TableIsAsGoodAsAPixel) {
  LampSettings settings;
  settings.inverse = CameraInverse::table;
  const test::LampScore found = score(settings);
  EXPECT_EQ(found.found, found.expected);
  EXPECT_GT(found.azimuth_rms(), 0.5);
  EXPECT_LT(found.azimuth_rms(), 1.3);
  EXPECT_GT(found.elevation_rms(), 0.5);
  EXPECT_LT(found.elevation_rms(), 1.3);
}

TEST(LampPerception, SeesTheSameInEveryFormat) {
  LampPerception gray(rig(), {});
  BearingSet expected, seen;
  gray.observe(views()[1].image.view(), expected);
  for (const PixelFormat format :
       {PixelFormat::yuyv, PixelFormat::uyvy, PixelFormat::rgb8, PixelFormat::bgr8, PixelFormat::nv12}) {
    LampPerception other(rig(), {});
    const test::Image image = test::in_format(views()[1].image, format);
    other.observe(image.view(), seen);
    ASSERT_EQ(seen.bearings.size(), expected.bearings.size()) << name(format);
    for (std::size_t k = 0; k < seen.bearings.size(); ++k)
      EXPECT_EQ(seen.bearings[k].azimuth_rad, expected.bearings[k].azimuth_rad);
  }
}

TEST(LampPerception, SaysHowFarFromTheCentreAndHowSure) {
  LampPerception perception(rig(), {});
  BearingSet seen;
  perception.observe(views()[0].image.view(), seen);
  ASSERT_EQ(seen.bearings.size(), perception.lamps().size());
  for (const Bearing& bearing : seen.bearings) {
    EXPECT_NEAR(bearing.radius_px, 200.0 * (kPi / 2 - bearing.elevation_rad), 1e-6);
    EXPECT_GT(bearing.sigma_rad, 0.1 / std::max(bearing.radius_px, 2.0) * 0.99);
    EXPECT_GT(bearing.sigma_elevation_rad, 0.1 / 200.0 * 0.99);
    EXPECT_LT(bearing.sigma_elevation_rad, 1.0 / 200.0);
    EXPECT_EQ(bearing.identity, kUnknownIdentity);
  }
}

TEST(LampPerception, TakesTheRigsWordForItsNoise) {
  CameraRig noisy = rig();
  noisy.image.sigma_px = 1.5;
  LampPerception perception(noisy, {});
  BearingSet seen;
  perception.observe(views()[0].image.view(), seen);
  ASSERT_FALSE(seen.bearings.empty());
  for (const Bearing& bearing : seen.bearings) EXPECT_NEAR(bearing.sigma_elevation_rad, 1.5 / 200.0, 1e-4);
}

TEST(LampPerception, RefusesWhatIsNoImageAndNeedsAModel) {
  LampPerception perception(rig(), {});
  BearingSet seen;
  perception.observe({}, seen);
  EXPECT_EQ(seen.trouble, ImageTrouble::unreadable);
  perception.observe(test::blank(PixelFormat::gray8, 640, 480).view(), seen);
  EXPECT_EQ(seen.trouble, ImageTrouble::unreadable) << "the rig says 1024 x 768";

  CameraRig radial = rig();
  radial.model = RadialRig{};
  LampPerception blind(radial, {});
  blind.observe(views()[0].image.view(), seen);
  EXPECT_TRUE(seen.bearings.empty());
}

TEST(LampPerception, NeverAllocatesOnceItHasSeenAnImage) {
  for (const PixelFormat format : {PixelFormat::gray8, PixelFormat::rgb8}) {
    LampPerception perception(rig(), {});
    BearingSet seen;
    std::vector<test::Image> images;
    for (const View& view : views()) images.push_back(test::in_format(view.image, format));
    for (const test::Image& image : images) perception.observe(image.view(), seen);
    const std::size_t before = allocations();
    for (const test::Image& image : images) perception.observe(image.view(), seen);
    EXPECT_EQ(allocations(), before);
  }
}

/// Paints a window into the wall: too large for a lamp, but as bright as one, so that brightness alone does not reject
/// it.
void open_window(std::vector<std::byte>& pixels, const CameraModel& camera, double azimuth_rad) {
  for (int v = 0; v < 768; ++v)
    for (int u = 0; u < 1024; ++u) {
      const auto seen = camera.direction({u, v});
      const bool inside = seen && std::abs(wrap(seen->azimuth_rad - azimuth_rad)) < 0.15 &&
                          seen->elevation_rad > 0.15 && seen->elevation_rad < 0.35;
      if (inside) pixels[static_cast<std::size_t>(1024 * v + u)] = std::byte{255};
    }
}

TEST(LampPerception, LeavesOutWindowsAsBrightAsLamps) {
  std::string problem;
  const std::optional<CameraModel> camera = camera_of(rig(), problem);
  ASSERT_TRUE(camera) << problem;
  LampSettings any_size;
  any_size.max_length_heights = any_size.max_area_heights2 = 1e6;
  LampPerception plain(rig(), {}), careful(rig(), {}), careless(rig(), any_size);
  BearingSet without, with, with_any;
  int lamps = 0, kept = 0, windows = 0, taken_for_lamps = 0;
  for (const View& view : views()) {
    test::Image image = view.image;
    plain.observe(image.view(), without);
    std::vector<Direction> opened;
    for (const double azimuth_rad : {-2.6, -1.0, 0.7, 2.1}) {
      const Direction middle{azimuth_rad, 0.25};
      if (test::nearest(without.bearings, middle, 0.35)) continue;  // the window would touch a lamp
      open_window(image.bytes, *camera, azimuth_rad);
      opened.push_back(middle);
    }
    careful.observe(image.view(), with);
    careless.observe(image.view(), with_any);
    for (const Bearing& each : with.bearings)
      EXPECT_TRUE(test::nearest(without.bearings, {each.azimuth_rad, each.elevation_rad}, 0.01));
    lamps += static_cast<int>(without.bearings.size());
    kept += static_cast<int>(with.bearings.size());
    windows += static_cast<int>(opened.size());
    for (const Direction& window : opened) taken_for_lamps += test::nearest(with_any.bearings, window, 0.1) ? 1 : 0;
  }
  EXPECT_GE(kept, 0.9 * lamps) << "small ones are no longer among the brightest";
  EXPECT_GE(windows, 6);
  EXPECT_EQ(taken_for_lamps, windows) << "else it was not their size that told them";
}

TEST(LampPerception, IsMadeForTheFrontEnd) {
  const auto made = make_perception(FrontEnd::lamps, rig(), {});
  ASSERT_TRUE(made);
  LampPerception bare(rig(), {});
  BearingSet seen, expected;
  made->observe(views()[0].image.view(), seen);
  bare.observe(views()[0].image.view(), expected);
  EXPECT_EQ(seen.bearings.size(), expected.bearings.size());
  EXPECT_FALSE(seen.bearings.empty());
}

}  // namespace
}  // namespace azimuth
