// A filter with estimates of its past poses.

#include "slam/hindsight/with_hindsight.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "sim/world/simulate.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

std::unique_ptr<Estimator> filter_for(const Rig& rig) { return make_ekf_estimator(rig, EkfSettings{}); }

struct FilterDrive {
  explicit FilterDrive(const Scenario& scenario) : FilterDrive(rig_of(scenario)) {}
  explicit FilterDrive(const Rig& rig) : stage(make_with_hindsight(filter_for(rig), rig, {}), rig, {}) {}

  void run(const World& world) {
    std::size_t reading = 0;
    for (const BearingSet& original : world.bearings) {
      for (; reading < world.odometry.size() && world.odometry[reading].stamp <= original.stamp; ++reading)
        stage.add(world.odometry[reading]);
      BearingSet set = original;
      stage.add(set);
      while (stage.advance(last)) poses.push_back({last.stamp, last.T_map_body});
    }
    for (; reading < world.odometry.size(); ++reading) stage.add(world.odometry[reading]);
    stage.finish();
    while (stage.advance(last)) poses.push_back({last.stamp, last.T_map_body});
  }

  EstimatorStage stage;
  Estimate last;
  std::vector<PathPose> poses;  // as estimated at the time
};

/// The root mean square position error, in the frame of the first pose.
template <class Pose>
double rmse_m(const World& world, const std::vector<Pose>& poses) {
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  double sum = 0.0;
  for (const Pose& pose : poses)
    sum += (T_world_map * pose.T_map_body.position() - true_pose(world, pose.stamp).position()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

TEST(WithHindsight, SaysOfThePresentWhatTheFilterDoes) {
  const Scenario scenario = lab(3, 1);
  const World world = simulate(scenario);
  FilterDrive drive(scenario);
  drive.run(world);
  StagedDrive alone(filter_for(rig_of(scenario)), rig_of(scenario));
  alone.run(world);
  EXPECT_EQ(drive.last.T_map_body, alone.last().T_map_body);
  EXPECT_EQ(drive.last.pose_covariance, alone.last().pose_covariance);
  ASSERT_EQ(drive.last.landmarks.size(), alone.last().landmarks.size());
  EXPECT_EQ(drive.last.landmarks.back().p_map_landmark_m, alone.last().landmarks.back().p_map_landmark_m);
}

TEST(WithHindsight, KnowsThePastBetterThanTheFilterDidThen) {
  const Scenario scenario = lab(4, 2);
  const World world = simulate(scenario);
  FilterDrive drive(scenario);
  drive.run(world);
  drive.stage.conclude();
  std::vector<PastPose> past;
  ASSERT_TRUE(drive.stage.estimator().write_past(past));
  ASSERT_EQ(past.size(), drive.poses.size());
  EXPECT_LT(rmse_m(world, past), 0.9 * rmse_m(world, drive.poses));
}

TEST(WithHindsight, ThePathIsOfThePastAtFewerInstants) {
  const Scenario scenario = lab(3, 1);
  FilterDrive drive(scenario);
  drive.run(simulate(scenario));
  std::vector<PastPose> past;
  std::vector<PathPose> path;
  ASSERT_TRUE(drive.stage.estimator().write_past(past));
  ASSERT_TRUE(drive.stage.estimator().write_path(path));
  ASSERT_GT(path.size(), 10U);
  EXPECT_LT(path.size(), past.size());
  std::size_t at = 0;
  for (const PathPose& pose : path) {
    while (at < past.size() && past[at].stamp < pose.stamp) ++at;
    ASSERT_LT(at, past.size());
    EXPECT_EQ(past[at].stamp, pose.stamp);
    EXPECT_LT((past[at].T_map_body.vector() - pose.T_map_body.vector()).norm(), 1e-12);
  }
}

TEST(WithHindsight, OnceConcludedTheMapIsThatOfTheGraph) {
  const Scenario scenario = lab(4, 2);
  const World world = simulate(scenario);
  FilterDrive drive(scenario);
  drive.run(world);
  MapSnapshot before, after;
  ASSERT_TRUE(drive.stage.save_map(before));
  drive.stage.conclude();
  ASSERT_TRUE(drive.stage.save_map(after));
  ASSERT_EQ(after.covariance.size(), after.entries());
  EXPECT_EQ(after.camera, before.camera);
  EXPECT_EQ(after.next_id, before.next_id);
  ASSERT_GE(after.landmarks.size(), 20U);
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  Estimate concluded;
  drive.stage.estimator().estimate(concluded);
  EXPECT_EQ(concluded.T_map_body, drive.last.T_map_body) << "the present is the filter's";
  for (std::size_t i = 0; i < after.landmarks.size(); ++i) {
    const MapLandmark& landmark = after.landmarks[i];
    const WorldLandmark& there = scenario.landmarks[static_cast<std::size_t>(landmark.identity)];
    const Eigen::Vector2d off = T_world_map * landmark.p_map_landmark_m - there.p_world_landmark_m;
    EXPECT_LT(off.norm(), 0.3) << landmark.identity;
    const std::size_t row = after.first_landmark_entry() + 2 * i;
    EXPECT_GT(after.covariance(row, row), 0.0);
    for (const LandmarkEstimate& published : concluded.landmarks)
      if (published.id == landmark.id) {
        EXPECT_EQ(published.p_map_landmark_m, landmark.p_map_landmark_m);
        EXPECT_GE(published.covariance_m2(0, 0), after.covariance(row, row)) << "and the scale's error";
      }
  }
}

}  // namespace
}  // namespace azimuth
