#include "slam/estimator/fastslam_estimator.hpp"

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

Estimate estimate_after(const LampRun& run, const FastSlamSettings& settings) {
  FastSlamEstimator estimator(run.rig, settings);
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
  }
  Estimate out;
  estimator.estimate(out);
  return out;
}

void expect_same(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.T_map_body, b.T_map_body);
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].id, b.landmarks[i].id);
    EXPECT_EQ(a.landmarks[i].p_map_landmark_m, b.landmarks[i].p_map_landmark_m);
  }
}

TEST(FastSlamEstimator, SameSeedSameBits) {
  const LampRun run = simulated_hall(1);
  FastSlamSettings settings;
  const Estimate first = estimate_after(run, settings);
  expect_same(first, estimate_after(run, settings));
  settings.seed = 2;
  EXPECT_NE(first.T_map_body, estimate_after(run, settings).T_map_body);
}

TEST(FastSlamEstimator, MapsHeightsAndIsTracking) {
  const Estimate estimate = estimate_after(simulated_hall(2), {});
  EXPECT_EQ(estimate.health, Health::tracking) << estimate.reason;
  EXPECT_GE(estimate.landmarks.size(), 12u);
  for (const LandmarkEstimate& lamp : estimate.landmarks) {
    EXPECT_NEAR(lamp.z_map_landmark_m, 6.5, 1.5);
    EXPECT_GT(lamp.sigma_z_m, 0.0);
  }
}

TEST(FastSlamEstimator, CountsWhatBecameOfTheMapItPublishes) {
  const Estimate estimate = estimate_after(simulated_hall(2), {});
  EXPECT_EQ(estimate.association.created, estimate.association.deleted + estimate.landmarks.size());
}

TEST(FastSlamEstimator, LookingAheadIsPredicting) {
  const LampRun run = simulated_hall(3);
  FastSlamEstimator estimator(run.rig, {});
  for (std::size_t i = 0; i < 50; ++i) {
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
  }
  Motion motion = run.motions[50];
  Estimate ahead, after;
  estimator.look_ahead(motion, ahead);
  estimator.predict(motion);
  estimator.estimate(after);
  EXPECT_NEAR((ahead.T_map_body.vector() - after.T_map_body.vector()).norm(), 0.0, 1e-12);
}

TEST(FastSlamEstimator, BearingsWithoutElevationAreNotUsed) {
  FastSlamEstimator estimator(lamp_rig(), {});
  BearingSet set;
  set.bearings.push_back({.azimuth_rad = 0.3});
  estimator.update(set);
  Estimate estimate;
  estimator.estimate(estimate);
  EXPECT_EQ(estimate.health, Health::starting);
  EXPECT_EQ(estimate.reason, "bearings bring no elevation");
}

TEST(FastSlamEstimator, MoreSightingsThanThereIsRoomForDoNoHarm) {
  FastSlamEstimator estimator(lamp_rig(), {});
  BearingSet set;
  for (int i = 0; i < 300; ++i)
    set.bearings.push_back({.azimuth_rad = wrap(0.1 * i), .elevation_rad = 0.4 + 0.003 * i});
  Motion motion;
  motion.T_start_end = {0.2, 0.0, 0.0};
  motion.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  motion.path_m = 0.2;
  for (int image = 0; image < 700; ++image) {  // further than paths are kept
    estimator.predict(motion);
    estimator.update(set);
  }
  Estimate estimate;
  estimator.estimate(estimate);
  EXPECT_TRUE(estimate.T_map_body.vector().allFinite());
}

/// Names need no association: a lamp keeps its name, and the drift that association has to bear is the same.
TEST(FastSlamEstimator, NamesAreBelieved) {
  LampRun run = simulated_hall(4);
  run.rig.camera.identities = true;
  for (std::size_t i = 0; i < run.sets.size(); ++i)
    for (std::size_t l = 0; l < run.sets[i].bearings.size(); ++l)
      run.sets[i].bearings[l].identity = run.lamp_of[i][l] == LampRun::kClutter ? kUnknownIdentity : run.lamp_of[i][l];
  const LampOutcome outcome = drive(run, {});
  EXPECT_EQ(outcome.wrong, 0u);
  EXPECT_GT(outcome.right, 50u);
  EXPECT_LT(outcome.position_mean_m, 0.6);
}

TEST(FastSlamEstimator, DoesNotAllocateOnceStarted) {
  const LampRun run = simulated_hall(5);
  FastSlamEstimator estimator(run.rig, {});
  Estimate out;
  out.landmarks.reserve(kTypicalLandmarks);
  std::size_t before = 0;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    if (i == run.sets.size() / 2) before = allocations();
    estimator.predict(run.motions[i]);
    estimator.update(run.sets[i]);
    out.landmarks.clear();
    estimator.estimate(out);
  }
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
