#include "slam/estimator/judgement.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {
namespace {

Evidence good() {
  Evidence evidence;
  evidence.landmarks = 10;
  evidence.pose_covariance = 1e-4 * Eigen::Matrix3d::Identity();
  return evidence;
}

TEST(Judgement, TracksWhenNothingSpeaksAgainstIt) {
  const Judgement judgement = judge(good(), {});
  EXPECT_EQ(judgement.health, Health::tracking);
  EXPECT_TRUE(judgement.reason.empty());
}

TEST(Judgement, DoesNotRelyOnACovarianceThatIsNone) {
  for (int i = 0; i < 3; ++i)
    for (const double variance : {std::numeric_limits<double>::quiet_NaN(), -1e-3}) {
      Evidence evidence = good();
      evidence.pose_covariance(i, i) = variance;
      if (i < 2 && variance < 0.0) evidence.pose_covariance(0, 0) = evidence.pose_covariance(1, 1) = variance;
      EXPECT_EQ(judge(evidence, {}).health, Health::lost) << i << " " << variance;
    }
}

Health with_sigma(double sigma_m, double map_reach_m, const HealthSettings& settings = {}) {
  Evidence evidence = good();
  evidence.pose_covariance(0, 0) = sigma_m * sigma_m;
  evidence.map_reach_m = map_reach_m;
  return judge(evidence, settings).health;
}

TEST(Judgement, AllowsMoreInALargerMapUnlessAKeySaysHowMuch) {
  // GIVEN a room, or a map whose size nobody knows
  for (const double reach_m : {0.0, 10.0, 25.0}) {
    EXPECT_EQ(with_sigma(0.49, reach_m), Health::tracking) << reach_m;
    EXPECT_EQ(with_sigma(0.51, reach_m), Health::degraded) << reach_m;
    EXPECT_EQ(with_sigma(5.1, reach_m), Health::lost) << reach_m;
  }
  // AND a park
  EXPECT_EQ(with_sigma(0.9, 100.0), Health::tracking);
  EXPECT_EQ(with_sigma(19.0, 100.0), Health::degraded);
  EXPECT_EQ(with_sigma(21.0, 100.0), Health::lost);
  // AND a map with a reach of 10 km, as if its positions were in millimetres
  EXPECT_EQ(with_sigma(51.0, 1e4), Health::lost);
  // AND configured limits
  HealthSettings said;
  said.degraded_sigma_m = 0.1;
  said.lost_sigma_m = 1.0;
  EXPECT_EQ(with_sigma(0.2, 100.0, said), Health::degraded);
  EXPECT_EQ(with_sigma(1.1, 100.0, said), Health::lost);
}

TEST(Judgement, NamesTheTroubleOfSeveralImagesInARow) {
  for (const auto trouble : {ImageTrouble::unreadable, ImageTrouble::dark, ImageTrouble::overexposed,
                             ImageTrouble::featureless, ImageTrouble::frozen, ImageTrouble::torn}) {
    Evidence evidence = good();
    evidence.trouble = trouble;
    evidence.troubled_images = 1;
    EXPECT_EQ(judge(evidence, {}).health, Health::tracking) << "one flash is no trouble";
    evidence.troubled_images = 5;
    EXPECT_EQ(judge(evidence, {}).health, Health::degraded);
    EXPECT_EQ(judge(evidence, {}).reason, to_string(trouble));
    evidence.landmarks = 0;
    EXPECT_EQ(judge(evidence, {}).health, Health::starting);
    EXPECT_EQ(judge(evidence, {}).reason, to_string(trouble));
  }
}

TEST(Judgement, CallsForACalibrationOnlyWhenTheOffsetIsCertain) {
  Evidence evidence = good();
  evidence.camera = {{8.0, 0.0, 0.0, 0.0}, Eigen::Vector4d(25.0, 25.0, 0.0, 0.0).asDiagonal()};
  EXPECT_EQ(judge(evidence, {}).health, Health::tracking);
  evidence.camera->covariance.topLeftCorner<2, 2>().setIdentity();
  EXPECT_EQ(judge(evidence, {}).reason, "the image's centre is not where the rig says");
  HealthSettings tolerant;
  tolerant.degraded_centre_px = 0.0;
  EXPECT_EQ(judge(evidence, tolerant).health, Health::tracking);
}

TEST(Judgement, CallsForACalibrationOnlyWhenTheTiltIsCertain) {
  Evidence evidence = good();
  evidence.camera = {{1.0, 0.0, 0.015, -0.015}, Eigen::Vector4d(25.0, 25.0, 1e-4, 1e-4).asDiagonal()};
  EXPECT_EQ(judge(evidence, {}).health, Health::tracking);
  evidence.camera->covariance.bottomRightCorner<2, 2>() *= 0.1;
  EXPECT_EQ(judge(evidence, {}).reason, "the camera leans otherwise than the rig says");
  HealthSettings tolerant;
  tolerant.degraded_tilt_rad = 0.0;
  EXPECT_EQ(judge(evidence, tolerant).health, Health::tracking);
}

TEST(Judgement, CallsForACalibrationOnlyWhenTheLagIsCertain) {
  Evidence evidence = good();
  evidence.lag = {.mean_s = -0.06, .sigma_s = 0.02};
  EXPECT_EQ(judge(evidence, {}).health, Health::tracking);
  evidence.lag->sigma_s = 0.005;
  EXPECT_EQ(judge(evidence, {}).health, Health::degraded);
  EXPECT_EQ(judge(evidence, {}).reason, "images and odometry are not of the same time");
  evidence.lag->mean_s = 0.025;  // certain, but too small to matter
  EXPECT_EQ(judge(evidence, {}).health, Health::tracking);
  evidence.lag->mean_s = 0.06;
  HealthSettings tolerant;
  tolerant.degraded_lag_s = 0.0;
  EXPECT_EQ(judge(evidence, tolerant).health, Health::tracking);
}

Motion straight_metre() {
  Motion motion;
  motion.T_start_end.x_m = motion.path_m = 1.0;
  return motion;
}

std::string_view reason_after_frozen_images(bool robot_moves) {
  EkfEstimator estimator({}, {});
  BearingSet frozen;
  frozen.trouble = ImageTrouble::frozen;
  for (int i = 0; i < 10; ++i) {
    if (robot_moves) estimator.predict(straight_metre());
    estimator.update(frozen);
  }
  Estimate estimate;
  estimator.estimate(estimate);
  return estimate.reason;
}

TEST(Judgement, AnImageThatStandsStillIsTroubleOnlyWhenTheRobotDoesNot) {
  EXPECT_EQ(reason_after_frozen_images(true), to_string(ImageTrouble::frozen));
  EXPECT_EQ(reason_after_frozen_images(false), "no landmark mapped yet");
}

}  // namespace
}  // namespace azimuth
