#include "tools/lens_fit/lens_fit.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/tools/lens_fit/simulated_lens_drive.hpp"
#include "tools/lens_fit/fisheye_calibration.hpp"

namespace azimuth {
namespace {

/// A lens whose coefficients are 3 % off and whose centre is 8 px off.
Lens perturbed(Lens lens) {
  lens.axes.centre_px += Pixel(6.0, -5.3);
  const std::array<double, 4> by{1.03, 0.97, 1.03, 1.03};
  for (std::size_t k = 0; k < 4; ++k) lens.c[k] *= by[k];
  return lens;
}

std::optional<LensSolution> found_from(const test::SimulatedLensDrive& drive, const Lens& start) {
  Lens lens = start;
  std::optional<LensSolution> solution;
  for (const TrackingGate& trust : {TrackingGate{15.0, 3.0}, TrackingGate{6.0, 1.0}}) {
    LensFitStart map = map_lamps(drive.motions, drive.images, lens, *drive.priors.lamp_height_m, trust);
    solution = fit_lens(map.drive, map.start, drive.priors);
    if (!solution) return solution;
    lens = solution->lens;
  }
  return solution;
}

TEST(LensFit, FindsAKnownLensFromAWrongOne) {
  const auto drive = test::simulated_lens_drive({});
  const auto found = found_from(drive, perturbed(drive.truth.lens));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rms_px(), 0.2 * std::sqrt(2.0), 0.03);
  EXPECT_GT(found->fitting(), 0.95);
  EXPECT_LT((found->lens.axes.centre_px - drive.truth.lens.axes.centre_px).norm(), 0.5);
  for (double theta = 0.2; theta < 1.3; theta += 0.1)
    EXPECT_NEAR(radius_px(found->lens, theta), radius_px(drive.truth.lens, theta),
                3.0 * sigma_radius_px(found->lens, found->of_lens(), theta))
        << theta;
}

/// The priors do not contain the tilt. The fit must not explain the tilt by a shifted centre.
TEST(LensFit, FindsHowTheLensLeans) {
  for (const CameraTilt& tilt : {CameraTilt{}, CameraTilt{0.035, 0.0}, CameraTilt{-0.012, 0.02}}) {
    auto drive = test::simulated_lens_drive({.tilt = tilt});
    drive.priors.sigma_tilt_rad = 0.05;
    const auto found = found_from(drive, test::known_lens());
    ASSERT_TRUE(found);
    const double sigma_rad = std::sqrt(std::max(found->covariance(kRoll, kRoll), found->covariance(kPitch, kPitch)));
    EXPECT_LT(sigma_rad, 2e-3);
    EXPECT_NEAR(found->lens.tilt.roll_rad, tilt.roll_rad, 3.5 * sigma_rad);
    EXPECT_NEAR(found->lens.tilt.pitch_rad, tilt.pitch_rad, 3.5 * sigma_rad);
    EXPECT_NEAR(found->rms_px(), 0.2 * std::sqrt(2.0), 0.03);
  }
}

TEST(LensFit, WithoutAHeightHoldsTheScale) {
  auto drive = test::simulated_lens_drive({});
  LensFitStart map = map_lamps(drive.motions, drive.images, drive.truth.lens, *drive.priors.lamp_height_m, {});
  drive.priors.lamp_height_m.reset();
  map.start.lamp_height_m = 4.0;
  const auto found = fit_lens(map.drive, map.start, drive.priors);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lens.c[0], drive.truth.lens.c[0], 1e-4);
  EXPECT_NEAR(found->lamp_height_m, drive.truth.lamp_height_m,
              3.0 * std::sqrt(found->covariance(kLampHeight, kLampHeight)));
}

TEST(LensFit, EquationsAreThoseOfDifferences) {
  auto drive = test::simulated_lens_drive({.seed = 3, .frames = 20, .lamps = 5, .tilt = {0.03, -0.05}});
  drive.priors.sigma_tilt_rad = 0.05;
  LensFitStart map = map_lamps(drive.motions, drive.images, drive.truth.lens, 4.7, {});
  for (LampObservation& each : map.drive.sightings) each.covariance_px2 *= 1e8;  // robust weight 1
  const LensSolution& at = map.start;
  const LensEquations equations = lens_equations(map.drive, at, at, drive.priors);
  constexpr double kStep = 1e-6;
  for (Eigen::Index k = 0; k < equations.J.cols(); ++k) {
    const Eigen::VectorXd off = kStep * Eigen::VectorXd::Unit(equations.J.cols(), k);
    const Eigen::VectorXd slope = (lens_equations(map.drive, lens_moved(at, off), at, drive.priors).e -
                                   lens_equations(map.drive, lens_moved(at, -off), at, drive.priors).e) /
                                  (2.0 * kStep);
    const Eigen::VectorXd column = equations.J.col(k);
    EXPECT_LT((column - slope).norm(), 1e-4 * std::max(1.0, slope.norm())) << k;
  }
}

TEST(LensFit, TwoLampsAreTooFew) {
  const auto drive = test::simulated_lens_drive({.lamps = 2});
  const LensFitStart map = map_lamps(drive.motions, drive.images, drive.truth.lens, 4.7, {});
  EXPECT_EQ(why_cannot_tell(map).find("only 2 lamps could be followed"), 0U) << why_cannot_tell(map);
}

}  // namespace
}  // namespace azimuth
