// Drives that last longer than what is kept of them.

#include <Eigen/Cholesky>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sim/world/simulate.hpp"
#include "slam/estimator/odometry_track.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "slam/hindsight/smoother_estimator.hpp"
#include "tests/support/large_hall.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

struct Errors {
  double rmse_m = 0.0, anees = 0.0;
};

/// Relative to the pose of the first image.
class ErrorSums {
 public:
  explicit ErrorSums(const World& world)
      : world_(world), T_world_map_(true_pose(world, world.bearings.front().stamp)) {}

  void add(Stamp stamp, const Pose2& T_map_body, const Eigen::Matrix3d& covariance) {
    Eigen::Vector3d off = T_map_body.vector() - (inverse(T_world_map_) * true_pose(world_, stamp)).vector();
    off.z() = wrap(off.z());
    square_m2_ += off.head<2>().squaredNorm();
    ++count_;
    if (covariance.diagonal().minCoeff() <= 0.0) return;  // the first one
    nees_ += off.dot(covariance.ldlt().solve(off));
    ++judged_;
  }
  Errors errors() const { return {std::sqrt(square_m2_ / count_), nees_ / judged_}; }

 private:
  const World& world_;
  Pose2 T_world_map_;
  double square_m2_ = 0.0, nees_ = 0.0;
  int count_ = 0, judged_ = 0;
};

struct Driven {
  Errors online, smoothed;
  std::int32_t poses = 0;
};

Driven driven(const Scenario& scenario, int max_keyframes) {
  const World world = simulate(scenario);
  const Rig rig = rig_of(scenario);
  HindsightSettings settings;
  settings.max_keyframes = max_keyframes;
  const auto made = make_smoother_estimator(rig, settings);
  auto& estimator = static_cast<SmootherEstimator&>(*made);
  OdometryTrack track(rig.odometry);
  std::size_t read = 0;
  ErrorSums online(world), smoothed(world);
  for (const BearingSet& set : world.bearings) {
    while (read < world.odometry.size() && (track.empty() || track.newest() < set.stamp))
      track.add(world.odometry[read++]);
    estimator.predict(track.advance_to(set.stamp).motion);
    estimator.update(set);
    const PoseGaussian pose = estimator.mapper().pose();
    online.add(set.stamp, pose.T_map_body, pose.covariance);
  }
  std::vector<PastPose> past;
  estimator.write_past(past);
  EXPECT_EQ(past.size(), world.bearings.size());
  for (const PastPose& pose : past) smoothed.add(pose.stamp, pose.T_map_body, pose.covariance);
  const BearingGraph& graph = estimator.mapper().smoother().graph();
  return {online.errors(), smoothed.errors(), graph.poses()};
}

TEST(LongDrive, AFewOfItsImagesAreEnoughToGoBy) {
  // GIVEN some minutes in a hall, and back where it began
  const Scenario scenario = large_hall(1, 5.0, {.landmarks = 60, .side_m = 16.0, .lane_m = 5.0});
  // WHEN no more than 150 of some 700 images are kept
  const Driven thinned = driven(scenario, 150);
  EXPECT_LE(thinned.poses, 150);
  // THEN a fifth of the bearings leave about twice the error, and what is said of it holds
  EXPECT_LT(thinned.online.rmse_m, 0.3);
  EXPECT_LT(thinned.smoothed.rmse_m, 0.5);
  EXPECT_LT(thinned.online.anees, 10.0);
  EXPECT_LT(thinned.smoothed.anees, 10.0);
}

}  // namespace
}  // namespace azimuth
