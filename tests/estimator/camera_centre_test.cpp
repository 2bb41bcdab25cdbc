// A camera whose image centre differs from rig.toml, because it was knocked or never calibrated. The estimator finds
// the offset by itself.

#include <Eigen/LU>
#include <cstdio>
#include <gmock/gmock.h>

#include "tests/geometry/random_draws.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

constexpr double kFar_px = 300.0;  // radius of the horizon in the image

/// Changes the bearings to those computed with a wrong image centre, `offset_px` short of the true one.
void knock(World& world, const Eigen::Vector2d& offset_px, RandomDraws& draws) {
  for (BearingSet& set : world.bearings)
    for (Bearing& bearing : set.bearings) {
      const double radius_px = kFar_px - draws.uniform(0.0, 150.0);
      const Eigen::Vector2d from_true =
          radius_px * Eigen::Vector2d(std::cos(bearing.azimuth_rad), std::sin(bearing.azimuth_rad));
      const Eigen::Vector2d from_assumed = from_true + offset_px;
      bearing.azimuth_rad = std::atan2(from_assumed.y(), from_assumed.x());
      bearing.radius_px = from_assumed.norm();
      bearing.kind = static_cast<Kind>(bearing.identity % 4);
    }
}

Rig image_rig(const Scenario& scenario, bool names) {
  Rig rig = rig_of(scenario);
  rig.camera.identities = names;
  rig.front_end = FrontEnd::colour;
  return rig;
}

struct KnockedDrive {
  double position_m;
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  Estimate last;
};

KnockedDrive drive_knocked(unsigned seed, bool names, const Eigen::Vector2d& offset_px, const EkfSettings& settings) {
  Scenario scenario = lab(seed, 2);
  World world = simulate(scenario);
  RandomDraws draws(seed);
  knock(world, offset_px, draws);
  SimulatedDrive drive(image_rig(scenario, names), settings);
  drive.run(world);
  KnockedDrive outcome{position_error_m(world, drive.last()), {}, {}, drive.last()};
  if (const auto found = drive.estimator().filter().camera_errors()) {
    outcome.offset_px = found->centre().mean_px;
    outcome.covariance_px2 = found->centre().covariance_px2;
  }
  return outcome;
}

class KnockedCamera : public testing::TestWithParam<bool> {};  // parameter: names, or else four colours

TEST_P(KnockedCamera, FindsItsCentre) {
  constexpr int kSeeds = 6;
  double with = 0.0, without = 0.0, nees = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    RandomDraws draws(100 + seed);
    const double direction_rad = draws.uniform(-kPi, kPi);
    const Eigen::Vector2d offset_px = 10.0 * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
    const KnockedDrive found = drive_knocked(seed, GetParam(), offset_px, {});
    EkfSettings trusting;
    trusting.centre.sigma_px = 0.0;
    with += found.position_m / kSeeds;
    without += drive_knocked(seed, GetParam(), offset_px, trusting).position_m / kSeeds;
    const Eigen::Vector2d error_px = found.offset_px - offset_px;
    EXPECT_LT(error_px.norm(), 3.0) << "seed " << seed;
    nees += error_px.dot(found.covariance_px2.inverse() * error_px) / kSeeds;
    EXPECT_EQ(found.last.health, Health::degraded);
    EXPECT_EQ(found.last.reason, "the image's centre is not where the rig says");
  }
  std::printf(
      "centre off by 10 px, %d drives: position off by %.2f m at the end (%.2f m when the rig is trusted), "
      "NEES of the centre %.1f of 2\n",
      kSeeds, with, without, nees);
  EXPECT_LT(with, 0.3);
  EXPECT_LT(with, 0.7 * without);
  EXPECT_LT(nees, 12.0);
}

TEST_P(KnockedCamera, LosesNothingWhenTheRigIsRight) {
  double estimated = 0.0, exact = 0.0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const KnockedDrive found = drive_knocked(seed, GetParam(), Eigen::Vector2d::Zero(), {});
    EkfSettings trusting;
    trusting.centre.sigma_px = 0.0;
    estimated += found.position_m / 6;
    exact += drive_knocked(seed, GetParam(), Eigen::Vector2d::Zero(), trusting).position_m / 6;
    EXPECT_EQ(found.last.health, Health::tracking) << found.last.reason;
  }
  std::printf("centre as the rig says: %.3f m with the centre as a state, %.3f m without\n", estimated, exact);
  EXPECT_LT(estimated, 2.0 * exact + 0.05);
}

std::string with_names(const testing::TestParamInfo<bool>& info) { return info.param ? "Named" : "Coloured"; }

INSTANTIATE_TEST_SUITE_P(, KnockedCamera, testing::Bool(), with_names);

TEST(CameraCentre, IsNoStateWhereBearingsComeReadyMade) {
  EXPECT_FALSE(EkfEstimator(Rig{}, {}).filter().camera_errors());
}

}  // namespace
}  // namespace azimuth
