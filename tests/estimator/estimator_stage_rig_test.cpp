// The rig's directions and clocks are applied before an estimator receives a sample.

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "slam/estimator/estimator_stage.hpp"
#include "tests/estimator/recording_estimator.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

TEST(EstimatorStage, AzimuthsThatGrowClockwiseAreTurnedRound) {
  Rig rig;
  rig.camera.azimuths_clockwise = true;
  std::vector<double> seen;
  std::vector<RecordingEstimator::Step> steps;
  EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), rig, StageSettings{0.5});
  stage.before_update([&seen](const BearingSet& set, const Estimator&) {
    for (const Bearing& bearing : set.bearings) seen.push_back(bearing.azimuth_rad);
  });
  stage.add(OdometryReading{at_s(0.0), 0, 0, {}});
  BearingSet set{at_s(0.0), 0, std::vector<Bearing>(2)};
  set.bearings[0].azimuth_rad = 1.0;
  set.bearings[1].azimuth_rad = -kPi;
  stage.add(set);
  Estimate estimate;
  ASSERT_TRUE(stage.advance(estimate));
  EXPECT_EQ(seen, (std::vector<double>{-1.0, -kPi}));
}

TEST(EstimatorStage, LaggingOdometryIsWaitedFor) {
  Rig rig;
  rig.odometry.lag_s = 0.2;
  std::vector<RecordingEstimator::Step> steps;
  EstimatorStage stage(std::make_unique<RecordingEstimator>(steps), rig, StageSettings{0.5});
  Estimate estimate;
  stage.add(OdometryReading{at_s(0.0), 0, 0, {}});
  BearingSet set{at_s(0.3), 0, {}};
  stage.add(set);
  stage.add(OdometryReading{at_s(0.05), 1, 0, {0.05, 0.0, 0.0}});  // valid at 0.25 s
  EXPECT_FALSE(stage.advance(estimate));
  stage.add(OdometryReading{at_s(0.15), 2, 0, {0.15, 0.0, 0.0}});  // valid at 0.35 s
  EXPECT_TRUE(stage.advance(estimate));
  EXPECT_NEAR(estimate.T_odom_body.x_m, 0.1, 1e-9);
}

}  // namespace
}  // namespace azimuth
