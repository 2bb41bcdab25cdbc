// Many reflections from the first image on. They must neither make a map without real lamps nor be reported as
// tracking.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "tests/support/lamp_crowd.hpp"

namespace azimuth {
namespace {

constexpr int kSeeds = 6;

CrowdOutcome drive_all(const LampCrowd& crowd) {
  CrowdOutcome sum;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const LampRun run = crowded_hall(crowd, seed);
    LampEkfEstimator estimator(run.rig, {});
    sum.add(follow(run, estimator));
  }
  print(crowd, sum);
  fmt::print("{:<28} ANEES {:.2f}\n", "", sum.anees);
  return sum;
}

/// The pose and its covariance must stay those of odometry.
TEST(LampEkfReflections, AloneAreNeverCalledTrackingAndMoveNothing) {
  const CrowdOutcome blind = drive_all({"nothing", false, 0});
  for (const LampCrowd& crowd :
       {LampCrowd{"5 anywhere", false, 5}, LampCrowd{"20 anywhere", false, 20}, LampCrowd{"60 anywhere", false, 60},
        LampCrowd{"120 anywhere", false, 120}, LampCrowd{"300 anywhere", false, 300}}) {
    const CrowdOutcome outcome = drive_all(crowd);
    EXPECT_EQ(outcome.tracking, 0) << crowd.title;
    EXPECT_EQ(outcome.lamps + outcome.phantoms, 0) << crowd.title;
    EXPECT_FALSE(outcome.reason.empty());
    EXPECT_NEAR(outcome.rmse_m(), blind.rmse_m(), 0.2 * blind.rmse_m()) << crowd.title;
    EXPECT_NEAR(outcome.anees, blind.anees, 0.5) << crowd.title;
  }
}

TEST(LampEkfReflections, OneThatRidesAlongIsNotCalledTracking) {
  const CrowdOutcome outcome = drive_all({"one that rides along", false, 0, true});
  EXPECT_EQ(outcome.tracking, 0);
  EXPECT_EQ(outcome.lamps + outcome.phantoms, 0);
}

/// Reflections must not make the run worse than a run without them.
TEST(LampEkfReflections, AmongLampsAreNotMapped) {
  const CrowdOutcome none = drive_all({"lamps alone", true, 0});
  for (const LampCrowd& crowd :
       {LampCrowd{"lamps, one rides along", true, 0, true}, LampCrowd{"lamps, 5 anywhere", true, 5},
        LampCrowd{"lamps, 20 anywhere", true, 20}, LampCrowd{"lamps, 60 anywhere", true, 60}}) {
    const CrowdOutcome outcome = drive_all(crowd);
    EXPECT_GE(outcome.tracking, none.tracking - 3 * kSeeds) << crowd.title;
    EXPECT_EQ(outcome.lamps, 16 * kSeeds) << crowd.title;
    EXPECT_EQ(outcome.phantoms, 0) << crowd.title;
    EXPECT_LE(outcome.rmse_m(), 1.2 * none.rmse_m()) << crowd.title;
    EXPECT_LE(outcome.anees, 4.0) << crowd.title;
  }
}

}  // namespace
}  // namespace azimuth
