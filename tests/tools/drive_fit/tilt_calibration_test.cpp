// Tests the calibration of the camera tilt from the azimuths of a drive.

#include "tools/drive_fit/tilt_calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/leaning_camera.hpp"
#include "tools/drive_fit/calibration.hpp"

namespace azimuth {
namespace {

using test::driven_with_good_images;
using test::kUpright;
using test::rig_of_images;
using test::seen_leaning;

std::optional<TiltCalibration> tilt_of(const Run& run) {
  const Rig rig = rig_of_images(run);
  const Drive drive = test::drive_of(run, rig);
  const HeadingCalibration heading = calibrate_heading(drive, rig, {});
  return calibrate_tilt(drive, heading.solution, {});
}

TEST(CalibrateTilt, IsFoundFromAzimuthsAlone) {
  for (const std::uint64_t seed : {31U, 32U})
    for (const CameraTilt& tilt : {CameraTilt{0.035, 0.0}, CameraTilt{-0.02, 0.03}}) {
      const auto found = tilt_of(seen_leaning(driven_with_good_images(seed), tilt, 1.5));
      ASSERT_TRUE(found && found->told && found->contradicts);
      fmt::print("seed {}: roll {:.4f} of {:.4f}, pitch {:.4f} of {:.4f}, +- {:.4f} rad\n", seed, found->tilt.roll_rad,
                 tilt.roll_rad, found->tilt.pitch_rad, tilt.pitch_rad, found->sigma_rad);
      EXPECT_NEAR(found->tilt.roll_rad, tilt.roll_rad, 3.0 * found->sigma_rad);
      EXPECT_NEAR(found->tilt.pitch_rad, tilt.pitch_rad, 3.0 * found->sigma_rad);
    }
}

TEST(CalibrateTilt, ALevelCameraStaysLevel) {
  const auto found = tilt_of(seen_leaning(driven_with_good_images(33), {}, 1.5));
  ASSERT_TRUE(found && found->told);
  EXPECT_FALSE(found->contradicts);
  EXPECT_TRUE(found->tilt.is_level());
}

TEST(CalibrateTilt, ThingsAtTheHorizonTellNothing) {
  const auto found = tilt_of(seen_leaning(driven_with_good_images(34), {0.035, 0.0}, 0.0));
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
