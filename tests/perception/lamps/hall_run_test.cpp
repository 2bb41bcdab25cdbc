// A ray-traced drive through a hall with windows, which is not shipped: every lamp must be found, and no window.

#include <gtest/gtest.h>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run_folder.hpp"
#include "settings/rig.hpp"
#include "slam/perception/lamps/lamp_perception.hpp"
#include "tests/perception/lamps/lamp_views.hpp"
#include "tests/support/data.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

constexpr int kEvery = 8;  // uses every eighth image

/// The run's rig measures the optical axis from pixel corners instead of pixel centres.
CameraRig rig_of(const Run& run) {
  CameraRig rig = read_rig(run.rig_toml, run.rig_file)->camera;
  rig.image.centre_px = {rig.image.centre_px->at(0) - 0.5, rig.image.centre_px->at(1) - 0.5};
  return rig;
}

std::vector<Direction> lamps_from(const Run& run, const CameraRig& rig, std::size_t image) {
  std::vector<Direction> lamps;
  for (const TrueLandmark& lamp : run.landmarks) {
    lamps.push_back(test::direction_to(run.truth[image].T_world_body, *rig.image.viewpoint_height_m,
                                       {lamp.x_m, lamp.y_m, lamp.z_m}));
  }
  return lamps;
}

/// `light`: brightness factors for consecutive images, repeated cyclically.
test::LampScore score(const Run& run, const LampSettings& settings, const std::vector<double>& light) {
  const CameraRig rig = rig_of(run);
  LampPerception perception(rig, settings);
  RunImages images(run);
  BearingSet seen;
  test::LampScore score;
  std::vector<std::byte> pixels;
  for (std::size_t k = 0; k < images.count(); k += kEvery) {
    ImageView image = images.pixels(k, PixelFormat::gray8);
    EXPECT_TRUE(image.readable()) << images.problem();
    pixels.assign(image.bytes.begin(), image.bytes.end());
    const double now = light[k / kEvery % light.size()];
    for (std::byte& pixel : pixels) pixel = static_cast<std::byte>(std::min(255.0, now * std::to_integer<int>(pixel)));
    image.bytes = pixels;
    perception.observe(image, seen);
    score.add(lamps_from(run, rig, k), seen.bearings);
  }
  return score;
}

class HallRun : public testing::TestWithParam<std::vector<double>> {};
INSTANTIATE_TEST_SUITE_P(Light, HallRun,
                         testing::Values(std::vector{1.0}, std::vector{0.4}, std::vector{1.4},
                                         std::vector{1.0, 0.5, 0.3, 1.4}),  // a hunting exposure control
                         test::PrintedName());

TEST_P(HallRun, EveryLampIsFoundAndNoWindow) {
  AZIMUTH_REQUIRE_DATA("hall-a");
  const auto run = read_run_folder(test::data_folder() / "hall-a");
  ASSERT_TRUE(run);
  const test::LampScore found = score(*run, {}, GetParam());
  RecordProperty("azimuth_rms", std::to_string(found.azimuth_rms()));
  RecordProperty("elevation_rms", std::to_string(found.elevation_rms()));
  EXPECT_GE(found.found, 0.995 * found.expected);
  EXPECT_LE(found.made_up, 0.02 * found.images);
  EXPECT_GT(found.azimuth_rms(), 0.5);
  EXPECT_LT(found.azimuth_rms(), 1.3);
  EXPECT_GT(found.elevation_rms(), 0.3);
  EXPECT_LT(found.elevation_rms(), 1.3);
}

}  // namespace
}  // namespace azimuth
