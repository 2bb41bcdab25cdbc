// The lamps that FastSLAM expects to see, between prediction and update.

#include <algorithm>
#include <gtest/gtest.h>

#include "slam/particles/fastslam_estimator.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

/// Statistics of the sightings that the filter then associates with a lamp of its map.
struct Expectations {
  int recognised = 0, in_own_gate = 0, expected = 0;
  double gate_area_rad2 = 0.0;
};

Expectations drive(LampRun run, double yaw_offset_rad, double gate_sigmas) {
  run.rig.camera.yaw_offset_rad = yaw_offset_rad;
  for (BearingSet& set : run.sets)
    for (Bearing& bearing : set.bearings) bearing.azimuth_rad = wrap(bearing.azimuth_rad - yaw_offset_rad);
  FastSlamSettings settings;
  settings.association.gate_sigmas = gate_sigmas;
  FastSlamEstimator estimator(run.rig, settings);
  Expectations seen;
  std::vector<ExpectedBearing> expected;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator.predict(run.motions[i]);
    estimator.expect(expected);
    for (const ExpectedBearing& one : expected) {
      EXPECT_GE(one.elevation_rad, kPi / 2.0 - *run.rig.camera.image.theta_max_rad);
      seen.gate_area_rad2 += one.gate_rad * one.gate_elevation_rad;
      ++seen.expected;
    }
    estimator.update(run.sets[i]);
    const auto lamps = estimator.filter().lamps_of_sightings();
    for (std::size_t l = 0; l < lamps.size(); ++l) {
      const auto own = std::ranges::find(expected, lamps[l], &ExpectedBearing::landmark);
      if (lamps[l] == FastSlam::kNoLamp || own == expected.end()) continue;
      ++seen.recognised;
      seen.in_own_gate += explains(*own, run.sets[i].bearings[l]) ? 1 : 0;
    }
  }
  return seen;
}

TEST(FastSlamExpectations, RecognisedSightingsLieInTheGateOfTheirLamp) {
  for (const double yaw_offset_rad : {0.0, 0.7}) {
    const Expectations seen = drive(simulated_hall(1), yaw_offset_rad, 8.0);
    EXPECT_GT(seen.recognised, 1500);
    EXPECT_GT(seen.in_own_gate, 0.995 * seen.recognised) << yaw_offset_rad;
  }
}

TEST(FastSlamExpectations, TheGateIsTheFiltersOwn) {
  const Expectations wide = drive(simulated_hall(1), 0.0, 8.0), narrow = drive(simulated_hall(1), 0.0, 5.0);
  EXPECT_GT(wide.gate_area_rad2 / wide.expected, 2.0 * narrow.gate_area_rad2 / narrow.expected);
}

TEST(FastSlamExpectations, NothingIsExpectedOfAnEmptyMap) {
  std::vector<ExpectedBearing> expected(3);
  FastSlamEstimator(lamp_rig(), {}).expect(expected);
  EXPECT_TRUE(expected.empty());
}

}  // namespace
}  // namespace azimuth
