#include "slam/planar/ekf_estimator.hpp"

#include <gtest/gtest.h>
#include <map>
#include <set>

#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

Rig all_round_rig() {
  Rig rig;
  rig.camera.identities = true;
  return rig;
}

Initialisation chosen_for(const Rig& rig) { return EkfEstimator(rig, {}).initialisation(); }

TEST(EkfEstimator, ByRigDelaysOnlyWhereTheQualityTestCanPass) {
  EXPECT_EQ(chosen_for(all_round_rig()), Initialisation::delayed);

  Rig narrow = all_round_rig();
  narrow.camera.field_of_view_rad = 1.05;
  EXPECT_EQ(chosen_for(narrow), Initialisation::undelayed);

  Rig nameless = all_round_rig();
  nameless.camera.identities = false;
  EXPECT_EQ(chosen_for(nameless), Initialisation::undelayed);

  Rig drifting = all_round_rig();
  drifting.odometry.lambda_drift_rad2_per_m = 1e-2;
  EXPECT_EQ(chosen_for(drifting), Initialisation::undelayed);
}

TEST(EkfEstimator, ConfigurationOverridesTheRig) {
  for (const Initialisation wanted : {Initialisation::delayed, Initialisation::undelayed}) {
    EkfSettings settings;
    settings.initialisation = wanted;
    EXPECT_EQ(EkfEstimator(all_round_rig(), settings).initialisation(), wanted);
  }
}

TEST(EkfEstimator, NamelessBearingsOfACameraThatReadsNamesAreIgnored) {
  EkfEstimator estimator(all_round_rig(), {});
  BearingSet set;
  set.bearings.resize(3);
  estimator.update(set);
  EXPECT_TRUE(estimator.landmarks().empty());
  EXPECT_TRUE(estimator.candidates().candidates().empty());
}

/// Properties of both kinds of initialisation, in the lab with known identities.
class InTheLab : public testing::TestWithParam<Initialisation> {
 protected:
  EkfSettings settings() const {
    EkfSettings settings;
    settings.initialisation = GetParam();
    return settings;
  }
  static Duration lap() { return std::chrono::seconds(72); }
};

INSTANTIATE_TEST_SUITE_P(Initialisation, InTheLab, testing::Values(Initialisation::delayed, Initialisation::undelayed),
                         test::PrintedName());

TEST_P(InTheLab, MapsEveryLandmarkSeenOnceUnderItsName) {
  const Scenario scenario = lab(1, 2);
  const World world = simulate(scenario);
  SimulatedDrive drive(rig_of(scenario), settings());
  drive.run(world);
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  std::set<Identity> names;
  for (const LandmarkEstimate& landmark : drive.last().landmarks) {
    EXPECT_TRUE(names.insert(landmark.identity).second);
    const Eigen::Vector2d truth = scenario.landmarks.at(static_cast<std::size_t>(landmark.identity)).p_world_landmark_m;
    EXPECT_LT((T_world_map * landmark.p_map_landmark_m - truth).norm(), 0.5) << "landmark " << landmark.identity;
  }
  EXPECT_GE(names.size(), 22u);
  EXPECT_EQ(drive.last().health, Health::tracking);
}

TEST_P(InTheLab, UsesEachLandmarkAtMostOnceInTheThinningTime) {
  const Scenario scenario = lab(2, 1);
  const World world = simulate(scenario);
  SimulatedDrive drive(rig_of(scenario), settings());
  std::map<std::int64_t, Stamp> last_used;
  drive.on_estimate = [&](const Estimate&) {
    for (const EkfEstimator::Landmark& landmark : drive.estimator().landmarks()) {
      const auto [known, is_new] = last_used.try_emplace(landmark.id, landmark.last_used);
      if (is_new || known->second == landmark.last_used) continue;
      EXPECT_GE(landmark.last_used - known->second, duration_from_seconds(0.5));
      known->second = landmark.last_used;
    }
  };
  drive.run(world);
  // at 5 Hz two of three bearings are thinned out
  EXPECT_GT(drive.last().association.thinned, drive.last().association.accepted);

  EkfSettings every_one = settings();
  every_one.thinning_s = 0.0;
  SimulatedDrive unthinned(rig_of(scenario), every_one);
  unthinned.run(world);
  EXPECT_EQ(unthinned.last().association.thinned, 0u);
  EXPECT_GT(unthinned.last().association.accepted, 2 * drive.last().association.accepted);
}

TEST_P(InTheLab, MapGrowsNoFurtherThanItMayAndStillServes) {
  EkfSettings small = settings();
  small.max_landmarks = 10;
  const Scenario scenario = lab(3, 2);
  const World world = simulate(scenario);
  SimulatedDrive drive(rig_of(scenario), small);
  drive.on_estimate = [](const Estimate& estimate) { ASSERT_LE(estimate.landmarks.size(), 10u); };
  drive.run(world);
  EXPECT_EQ(drive.last().landmarks.size(), 10u);
  EXPECT_EQ(drive.last().health, Health::degraded);
  EXPECT_LT(position_error_m(world, drive.last()), 0.5);
}

TEST_P(InTheLab, LandmarkThatWasMovedIsFoundAgain) {
  // After one lap somebody moves a landmark by three metres.
  Scenario scenario = lab(4, 3);
  World world = simulate(scenario);
  const std::size_t moved = 5;
  scenario.landmarks[moved].p_world_landmark_m +=
      Eigen::Vector2d(0.0, scenario.landmarks[moved].p_world_landmark_m.y() < 5.0 ? 3.0 : -3.0);
  const World afterwards = simulate(scenario);
  for (std::size_t i = 0; i < world.bearings.size(); ++i)
    if (world.bearings[i].stamp > Stamp{lap()}) world.bearings[i] = afterwards.bearings[i];

  SimulatedDrive drive(rig_of(scenario), settings());
  drive.run(world);
  EXPECT_GT(drive.last().association.recovered, 0u);
  const Pose2 T_world_map = true_pose(world, world.bearings.front().stamp);
  int found = 0;
  for (const LandmarkEstimate& landmark : drive.last().landmarks) {
    if (landmark.identity != static_cast<Identity>(moved)) continue;
    ++found;
    EXPECT_LT((T_world_map * landmark.p_map_landmark_m - scenario.landmarks[moved].p_world_landmark_m).norm(), 0.5);
  }
  EXPECT_EQ(found, 1);
  EXPECT_LT(position_error_m(world, drive.last()), 0.2);
  EXPECT_EQ(drive.last().health, Health::tracking);
}

/// Adds a motion that never happened to the odometry from `when` on.
void slip(World& world, Stamp when, const Pose2& T_before_after) {
  const auto first = std::ranges::find_if(world.odometry, [&](const auto& reading) { return reading.stamp >= when; });
  const Pose2 T_odom_there = first->T_odom_body;
  for (auto reading = first; reading != world.odometry.end(); ++reading)
    reading->T_odom_body = T_odom_there * T_before_after * inverse(T_odom_there) * reading->T_odom_body;
}

TEST_P(InTheLab, PoseIsFoundAgainAfterTheWheelsSlipped) {
  constexpr int kSeeds = 10;
  int found = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario scenario = lab(static_cast<std::uint64_t>(seed), 3);
    World world = simulate(scenario);
    slip(world, Stamp{lap() + std::chrono::seconds(20)}, {0.8, -0.4, 0.6});
    SimulatedDrive drive(rig_of(scenario), settings());
    drive.run(world);
    EXPECT_GT(drive.last().association.recovered, 0u);
    const double error_m = position_error_m(world, drive.last());
    const bool right = error_m < 0.3 && drive.last().health == Health::tracking;
    if (!right)
      std::printf("seed %d: %.2f m off at the end, %s\n", seed, error_m, to_string(drive.last().health).data());
    found += right ? 1 : 0;
  }
  std::printf("found again: %d of %d\n", found, kSeeds);
  EXPECT_EQ(found, kSeeds);
}

/// The wheels turn freely or the robot is carried. Odometry then misses metres and half a turn, and reports the gap.
TEST_P(InTheLab, TheMapStaysWhereItIsWhenOdometryIsMissing) {
  constexpr int kSeeds = 10;
  double worst_m = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario scenario = lab(static_cast<std::uint64_t>(seed), 6);
    World world = simulate(scenario);
    std::uint32_t origin = 0;
    for (int outage = 0; outage < 20; ++outage) {  // outages of 3 s, one every 15 s, from the second lap on
      const Stamp from = Stamp{lap() + std::chrono::seconds(15 * outage)}, until = from + std::chrono::seconds(3);
      std::erase_if(world.odometry, [&](const OdometryReading& r) { return r.stamp > from && r.stamp < until; });
      const auto next =
          std::ranges::find_if(world.odometry, [&](const OdometryReading& r) { return r.stamp >= until; });
      if (next == world.odometry.end()) break;
      ++origin;
      for (auto reading = next; reading != world.odometry.end(); ++reading) reading->origin = origin;
      next->sigma_gap_m = 3.0;
      next->sigma_gap_rad = 2.0;
    }
    SimulatedDrive drive(rig_of(scenario), settings());
    drive.on_estimate = [](const Estimate& estimate) {
      EXPECT_TRUE(estimate.health != Health::lost || estimate.pose_covariance(2, 2) > 0.25) << estimate.reason;
    };
    drive.run(world);
    EXPECT_EQ(drive.last().health, Health::tracking);
    worst_m = std::max(worst_m, position_error_m(world, drive.last()));
  }
  std::printf("position after 20 outages: at most %.2f m off in %d runs\n", worst_m, kSeeds);
  EXPECT_LT(worst_m, 0.3);
}

TEST_P(InTheLab, CameraYawConverges) {
  Scenario scenario = lab(6, 2);
  scenario.sensor.yaw_offset_rad = 0.1;
  const World world = simulate(scenario);
  Rig rig = rig_of(scenario);
  rig.camera.yaw_offset_rad = 0.04;  // a wrong value in the rig
  EkfSettings estimated = settings();
  estimated.camera_yaw.estimate = true;
  SimulatedDrive drive(rig, estimated);
  EXPECT_EQ(drive.estimator().filter().yaw_offset_rad(), 0.04);
  drive.run(world);
  EXPECT_NEAR(drive.estimator().filter().yaw_offset_rad(), 0.1, 0.01);
  EXPECT_LT(position_error_m(world, drive.last()), 0.2);

  EkfSettings fixed = settings();
  SimulatedDrive wrong(rig, fixed);
  wrong.run(world);
  EXPECT_EQ(wrong.estimator().filter().yaw_offset_rad(), 0.04);
}

TEST_P(InTheLab, ANameTwiceInAnImageIsNeverTwoLandmarks) {
  const Scenario scenario = lab(7, 1);
  World world = simulate(scenario);
  for (BearingSet& set : world.bearings) {
    if (set.bearings.empty()) continue;
    Bearing misread = set.bearings.front();
    misread.azimuth_rad = wrap(misread.azimuth_rad + 2.0);
    set.bearings.push_back(misread);
  }
  SimulatedDrive drive(rig_of(scenario), settings());
  drive.on_estimate = [](const Estimate& estimate) {
    std::set<Identity> names;
    for (const LandmarkEstimate& landmark : estimate.landmarks)
      ASSERT_TRUE(names.insert(landmark.identity).second) << "landmark " << landmark.identity << " is mapped twice";
  };
  drive.run(world);
  EXPECT_LT(position_error_m(world, drive.last()), 0.3);
}

TEST_P(InTheLab, LandmarkIdentifiersAreNeverUsedAgain) {
  const Scenario scenario = lab(8, 2);
  World world = simulate(scenario);
  slip(world, Stamp{lap()}, {1.0, 1.0, 1.0});
  SimulatedDrive drive(rig_of(scenario), settings());
  std::set<std::int64_t> alive, gone;
  drive.on_estimate = [&](const Estimate& estimate) {
    std::set<std::int64_t> now;
    for (const LandmarkEstimate& landmark : estimate.landmarks) now.insert(landmark.id);
    for (const std::int64_t id : alive)
      if (!now.contains(id)) gone.insert(id);
    for (const std::int64_t id : now) EXPECT_FALSE(gone.contains(id));
    alive = now;
  };
  drive.run(world);
  const AssociationCounts& counts = drive.last().association;
  EXPECT_EQ(counts.created - counts.deleted, drive.last().landmarks.size());
}

TEST_P(InTheLab, LookAheadIsWhatPredictingWouldGive) {
  const Scenario scenario = lab(9, 1);
  SimulatedDrive drive(rig_of(scenario), settings());
  drive.run(simulate(scenario));
  Motion motion;
  motion.T_start_end = {0.2, 0.05, 0.1};
  motion.path_m = 0.21;
  Estimate ahead, now;
  drive.estimator().look_ahead(motion, ahead);
  drive.estimator().estimate(now);
  const Pose2 expected = now.T_map_body * motion.T_start_end;
  EXPECT_LT((ahead.T_map_body.vector() - expected.vector()).norm(), 1e-12);
  EXPECT_TRUE(ahead.landmarks.empty());
  EXPECT_EQ(now.T_map_body, drive.last().T_map_body);  // look_ahead() has not advanced the filter
  EXPECT_EQ(now.pose_covariance, drive.last().pose_covariance);
}

}  // namespace
}  // namespace azimuth
