#include "slam/particles/fastslam_estimator.hpp"

#include <gtest/gtest.h>

#include "slam/camera/camera_model.hpp"
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
  for (int image = 0; image < 700; ++image) {  // more images than paths keep
    estimator.predict(motion);
    estimator.update(set);
  }
  Estimate estimate;
  estimator.estimate(estimate);
  EXPECT_TRUE(estimate.T_map_body.vector().allFinite());
}

/// Detections that claim a tenth of a pixel, for lamps 5 m away. This corresponds to 2 mm, and no particle knows its
/// own path that well.
TEST(FastSlamEstimator, SightingsThatClaimTooMuchDoNoHarm) {
  LampRun run = simulated_hall(6);
  for (std::size_t i = 0; i < run.sets.size(); ++i)
    for (std::size_t l = 0; l < run.sets[i].bearings.size(); ++l) {
      Bearing& bearing = run.sets[i].bearings[l];
      if (run.lamp_of[i][l] != LampRun::kClutter) {
        const Eigen::Vector3d& lamp = run.lamps[static_cast<std::size_t>(run.lamp_of[i][l])];
        const Eigen::Vector2d flat = inverse(run.truth[i]) * Eigen::Vector2d(lamp.head<2>());
        const Direction exact = direction(Eigen::Vector3d(flat.x(), flat.y(), lamp.z() - 1.8));
        bearing.azimuth_rad = exact.azimuth_rad;
        bearing.elevation_rad = exact.elevation_rad;
      }
      bearing.sigma_elevation_rad = 5e-4;
      bearing.sigma_rad = 5e-4 / std::cos(bearing.elevation_rad);
    }
  const auto mean_m = [&run](double sigma_floor_rad) {
    FastSlamSettings settings = paper_fastslam_preset();
    settings.association.sigma_floor_rad = sigma_floor_rad;
    double sum_m = 0.0;
    constexpr int kSeeds = 4;
    for (settings.seed = 1; settings.seed <= kSeeds; ++settings.seed) sum_m += drive(run, settings).position_mean_m;
    return sum_m / kSeeds;
  };
  const double with_floor_m = mean_m(FastSlamSettings{}.association.sigma_floor_rad), believing_m = mean_m(0.0);
  EXPECT_LT(with_floor_m, 0.25);
  EXPECT_GT(believing_m, 2.0 * with_floor_m) << "hardly a crossing agrees with all its sightings";
}

/// Lamps with identities need no association: a lamp keeps its identity. The drift is the same as with association.
TEST(FastSlamEstimator, NamesAreBelieved) {
  LampRun run = simulated_hall(4);
  run.rig.camera.identities = true;
  for (std::size_t i = 0; i < run.sets.size(); ++i)
    for (std::size_t l = 0; l < run.sets[i].bearings.size(); ++l)
      run.sets[i].bearings[l].identity = run.lamp_of[i][l] == LampRun::kClutter ? kUnknownIdentity : run.lamp_of[i][l];
  const LampOutcome outcome = drive(run, FastSlamSettings{});
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
