// Tests the rough search for a rig, which works from an arbitrarily wrong rig.

#include "tools/drive_fit/short_stretches.hpp"

#include <gtest/gtest.h>

#include "tests/support/drive_of.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

std::vector<RigGuess> searched(const Run& run, const RoughSearch& search) {
  const Rig rig = test::rig_of_run(run);
  const Drive drive = test::drive_of(run, rig);
  ShortStretches stretches(drive, rig);
  return rough_guesses(stretches, {.rig = rig}, search);
}

TEST(ShortStretches, AGoodRigIsLeftAsItIs) {
  const auto run = simulated_run(lab(3, 1));
  const RigGuess best = searched(run, {.hand = true, .yaw = true, .turn = true, .lag = true}).front();
  EXPECT_FALSE(best.mirrored);
  EXPECT_NEAR(best.rig.camera.yaw_offset_rad, 0.0, 0.08);
  EXPECT_NEAR(best.rig.odometry.scale_turn, 1.0, 0.06);
  EXPECT_NEAR(best.rig.odometry.lag_s, 0.0, 0.11);
}

TEST(ShortStretches, HandAndHeadingAreFoundFromAnywhere) {
  for (const double yaw_rad : {-2.5, 0.7, 1.6}) {
    const auto run = test::with_mirrored_azimuths(test::with_turned_camera(simulated_run(lab(4, 1)), yaw_rad));
    const RigGuess best = searched(run, {.hand = true, .yaw = true}).front();
    EXPECT_TRUE(best.mirrored);
    EXPECT_NEAR(wrap(best.rig.camera.yaw_offset_rad + yaw_rad), 0.0, 0.15) << yaw_rad;
  }
}

TEST(ShortStretches, ATurnScaleFarOffIsFound) {
  const auto run = test::with_scaled_turns(simulated_run(lab(5, 1)), 1.3);
  EXPECT_NEAR(searched(run, {.turn = true}).front().rig.odometry.scale_turn, 1.0 / 1.3, 0.06);
}

TEST(ShortStretches, WithoutNamesThereIsNothingToJudge) {
  auto run = simulated_run(lab(6, 1));
  for (BearingSet& set : run.bearings)
    for (Bearing& bearing : set.bearings) bearing.identity = kUnknownIdentity;
  const Rig rig = test::rig_of_run(run);
  const Drive drive = test::drive_of(run, rig);
  ShortStretches stretches(drive, rig);
  EXPECT_EQ(stretches.judged(), 0U);
  EXPECT_EQ(stretches.cost({.rig = rig}), ShortStretches::kMostCost);
}

}  // namespace
}  // namespace azimuth
