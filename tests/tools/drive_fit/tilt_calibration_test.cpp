// How a camera leans, by the azimuths of a drive.

#include "tools/drive_fit/tilt_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/random.hpp"
#include "tests/support/drive_of.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

const CameraModel kUpright({{320.0, 240.0}, 1.0, -1, -kPi / 2.0}, ParabolicMirror{140.0});

Rig rig_of_images(const Run& run) {
  Rig rig = test::rig_of_run(run);
  rig.front_end = FrontEnd::colour;
  rig.camera.model = ParabolicMirrorRig{.horizon_radius_px = 140.0};
  rig.camera.image.centre_px = {320.0, 240.0};
  rig.camera.image.azimuth_offset_rad = -kPi / 2.0;
  return rig;
}

/// Landmarks above and below the camera by up to so much, seen through one that leans, by somebody who does not know.
Run seen_leaning(Run run, const CameraTilt& tilt, double highest_m) {
  const CameraModel camera(kUpright.axes(), kUpright.profile(), tilt);
  RandomNumbers<Xoshiro> random{Xoshiro(7)};
  std::map<Identity, double> height_m;
  for (const TrueLandmark& landmark : run.landmarks)
    height_m[landmark.identity] = highest_m * (2.0 * random.uniform() - 1.0);
  for (BearingSet& set : run.bearings) {
    const auto at = std::ranges::lower_bound(run.truth, set.stamp, {}, &TruthPose::stamp);
    const Pose2& T_world_body = (at == run.truth.end() ? run.truth.back() : *at).T_world_body;
    for (Bearing& bearing : set.bearings) {
      const auto landmark = std::ranges::find(run.landmarks, bearing.identity, &TrueLandmark::identity);
      if (landmark == run.landmarks.end()) continue;
      const double distance_m = (Eigen::Vector2d(landmark->x_m, landmark->y_m) - T_world_body.position()).norm();
      const auto pixel =
          camera.pixel(Direction{bearing.azimuth_rad, std::atan2(height_m[landmark->identity], distance_m)});
      const PolarPixel seen = kUpright.axes().polar(*pixel);
      bearing.azimuth_rad = seen.azimuth_rad;
      bearing.radius_px = seen.radius_px;
    }
  }
  return run;
}

/// By bearings as good as those of images are.
Run driven(std::uint64_t seed) {
  Scenario scenario = lab(seed, 2);
  scenario.sensor.sigma_bearing_rad = 0.005;
  return simulated_run(scenario);
}

std::optional<TiltCalibration> tilt_of(const Run& run) {
  const Rig rig = rig_of_images(run);
  const Drive drive = test::drive_of(run, rig);
  const HeadingCalibration heading = calibrate_heading(drive, rig, {});
  return calibrate_tilt(drive, heading.solution, {});
}

TEST(CalibrateTilt, IsFoundFromAzimuthsAlone) {
  for (const std::uint64_t seed : {31U, 32U})
    for (const CameraTilt& tilt : {CameraTilt{0.035, 0.0}, CameraTilt{-0.02, 0.03}}) {
      const auto found = tilt_of(seen_leaning(driven(seed), tilt, 1.5));
      ASSERT_TRUE(found && found->told && found->contradicts);
      fmt::print("seed {}: roll {:.4f} of {:.4f}, pitch {:.4f} of {:.4f}, +- {:.4f} rad\n", seed, found->tilt.roll_rad,
                 tilt.roll_rad, found->tilt.pitch_rad, tilt.pitch_rad, found->sigma_rad);
      EXPECT_NEAR(found->tilt.roll_rad, tilt.roll_rad, 3.0 * found->sigma_rad);
      EXPECT_NEAR(found->tilt.pitch_rad, tilt.pitch_rad, 3.0 * found->sigma_rad);
    }
}

TEST(CalibrateTilt, ALevelCameraStaysLevel) {
  const auto found = tilt_of(seen_leaning(driven(33), {}, 1.5));
  ASSERT_TRUE(found && found->told);
  EXPECT_FALSE(found->contradicts);
  EXPECT_TRUE(found->tilt.is_level());
}

TEST(CalibrateTilt, ThingsAtTheHorizonTellNothing) {
  const auto found = tilt_of(seen_leaning(driven(34), {0.035, 0.0}, 0.0));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->told);
}

TEST(CalibrateTilt, BearingsThatAreOfNoImageHaveNone) {
  const auto run = simulated_run(lab(35, 1));
  const Rig rig = test::rig_of_run(run);
  const Drive drive = test::drive_of(run, rig);
  EXPECT_FALSE(calibrate_tilt(drive, calibrate_heading(drive, rig, {}).solution, {}));
}

TEST(Relevelled, IsWhatTheCameraThatLeansSees) {
  const CameraTilt tilt{.roll_rad = 0.03, .pitch_rad = -0.02};
  const CameraModel camera(kUpright.axes(), kUpright.profile(), tilt);
  for (double u = 210.0; u < 440.0; u += 23.0) {
    const PolarPixel seen = kUpright.axes().polar({u, 300.0});
    Bearing bearing{.azimuth_rad = seen.azimuth_rad};
    EXPECT_EQ(relevelled(bearing, kUpright, tilt).azimuth_rad, seen.azimuth_rad) << "nobody knows how high it is";
    bearing.radius_px = seen.radius_px;
    EXPECT_NEAR(relevelled(bearing, kUpright, tilt).azimuth_rad, camera.direction({u, 300.0})->azimuth_rad, 1e-12);
  }
}

}  // namespace
}  // namespace azimuth
