// LampEkfEstimator: saving and loading maps of lamps in space.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "drivers/storage/map_codec.hpp"
#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/driven_lamps.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kSaved = 160;  // number of images, more than a round
constexpr std::size_t kElsewhere = 210;
constexpr double kFarOff_m = 0.8;  // irregularity of the hall's grid of lamps

using Robot = test::DrivenLamps<LampEkfEstimator>;

Robot robot_of(const LampRun& run, const MapStart& start = {}, std::size_t first = 0) {
  return {run, LampEkfEstimator(run.rig, {}, start), first};
}

class SavedLampMap : public testing::Test {
 protected:
  explicit SavedLampMap(double off_m = kFarOff_m) : run_(simulated_hall(4, off_m)) {
    Robot first = robot_of(run_);
    first.to(kSaved);
    saved_ = first.estimator.save_map(map_);
  }

  LampRun run_;
  MapSnapshot map_;
  bool saved_ = false;
};

TEST_F(SavedLampMap, HoldsLampsInSpaceWithTheirJointCovariance) {
  ASSERT_TRUE(saved_);
  EXPECT_EQ(map_.landmarks.size(), run_.lamps.size());
  EXPECT_EQ(map_.covariance.size(), map_.entries());
  EXPECT_EQ(map_.entries(), map_.first_landmark_entry() + 3 * map_.landmarks.size());
  std::size_t height = map_.first_landmark_entry() + 2;
  for (const MapLandmark& lamp : map_.landmarks) {
    EXPECT_LT(lamp.id, map_.next_id);
    EXPECT_LT(std::abs(lamp.z_map_landmark_m - 6.5), 4.0 * std::sqrt(map_.covariance(height, height)) + 0.01);
    height += 3;
  }
}

TEST_F(SavedLampMap, ComesBackFromAFileAndGoesOnAsIfNothingHadHappened) {
  // WHEN one robot continues from the map and the pose in the file, and another one drives without a restart
  std::vector<std::byte> file;
  ASSERT_EQ(implausible(map_), std::nullopt);
  encode(map_, file);
  MapSnapshot loaded;
  ASSERT_EQ(decode_map(file, loaded), std::nullopt);
  EXPECT_EQ(loaded.covariance, map_.covariance);
  Robot uninterrupted = robot_of(run_);
  Robot restarted =
      robot_of(run_, {.map = &loaded, .pose_known = true, .sigma_position_m = 0.0, .sigma_heading_rad = 0.0}, kSaved);
  uninterrupted.to(run_.sets.size());
  restarted.to(run_.sets.size());
  // THEN both agree. Only lamps on probation are lost.
  const Estimate one = uninterrupted.estimate(), other = restarted.estimate();
  const Pose2 apart = inverse(one.T_map_body) * other.T_map_body;
  EXPECT_LT(apart.position().norm(), 0.01);
  EXPECT_LT(std::abs(apart.heading_rad), 0.002);
  EXPECT_EQ(other.health, Health::tracking) << other.reason;
  EXPECT_EQ(other.landmarks.size(), one.landmarks.size());
  EXPECT_LT(restarted.error_m(), 0.5);
}

TEST_F(SavedLampMap, IsKeptToTheLastBitByARobotThatOnlyLocalises) {
  Robot robot = robot_of(run_, {.map = &map_, .mode = MapMode::localise, .pose_known = true}, kSaved);
  double worst_m = 0.0;
  while (robot.next < run_.sets.size()) {
    robot.step();
    worst_m = std::max(worst_m, robot.error_m());
  }
  const Estimate last = robot.estimate();
  EXPECT_LT(worst_m, 0.5);
  EXPECT_EQ(last.health, Health::tracking) << last.reason;
  EXPECT_GT(last.association.accepted, 500u);
  MapSnapshot kept;
  ASSERT_TRUE(robot.estimator.save_map(kept));
  test::expect_same_lamps(kept, map_);
}

TEST_F(SavedLampMap, ForgivesARobotThatWasPushed) {
  map_.T_map_body = map_.T_map_body * Pose2{0.2, -0.2, 0.15};
  Robot robot = robot_of(run_, {.map = &map_, .pose_known = true}, kSaved);
  robot.to(run_.sets.size());
  EXPECT_LT(robot.error_m(), 0.5);
  EXPECT_EQ(robot.estimate().health, Health::tracking);
}

TEST_F(SavedLampMap, ShowsARobotThatDoesNotKnowWhereItIs) {
  for (const MapMode mode : {MapMode::localise, MapMode::extend}) {
    // GIVEN a robot that knows the map but not its pose, and that was carried far away
    Robot robot = robot_of(run_, {.map = &map_, .mode = mode}, kElsewhere);
    ASSERT_TRUE(robot.estimator.searching());
    MapSnapshot unwanted;
    EXPECT_FALSE(robot.estimator.save_map(unwanted)) << "a robot that is lost has nothing to add to its map";
    // WHEN the robot drives on
    double worst_m = 0.0, found_after_m = 0.0;
    for (std::size_t i = kElsewhere; i < run_.sets.size(); ++i) {
      robot.step();
      const Estimate now = robot.estimate();
      EXPECT_EQ(now.health == Health::lost, robot.estimator.searching());
      if (robot.estimator.searching()) {
        EXPECT_FALSE(now.reason.empty());
        found_after_m += run_.motions[i].path_m;
      } else {
        worst_m = std::max(worst_m, robot.error_m());
      }
    }
    // THEN it is relocalised within metres, at its true pose
    ASSERT_FALSE(robot.estimator.searching());
    EXPECT_LT(found_after_m, 5.0);
    EXPECT_LT(worst_m, 0.5);
    EXPECT_EQ(robot.estimate().health, Health::tracking);
    MapSnapshot kept;
    ASSERT_TRUE(robot.estimator.save_map(kept));
    EXPECT_EQ(kept.landmarks.size(), map_.landmarks.size());
    if (mode == MapMode::localise) test::expect_same_lamps(kept, map_);
  }
}

TEST_F(SavedLampMap, IsHandedOverWithoutAllocatingOnceItsStorageHasGrown) {
  Robot robot = robot_of(run_, {.map = &map_, .pose_known = true}, kSaved);
  MapSnapshot out;
  ASSERT_TRUE(robot.estimator.save_map(out));
  const std::size_t before = allocations();
  ASSERT_TRUE(robot.estimator.save_map(out));
  EXPECT_EQ(allocations() - before, 0u);
}

class SavedMapOfARegularGrid : public SavedLampMap {
 protected:
  SavedMapOfARegularGrid() : SavedLampMap(0.0) {}
};

TEST_F(SavedMapOfARegularGrid, IsNoPlaceToGuessIn) {
  // GIVEN a hall that looks the same after half a turn
  Robot robot = robot_of(run_, {.map = &map_}, kElsewhere);
  // WHEN a robot that does not know its pose drives in the hall
  robot.to(run_.sets.size());
  // THEN the robot may stay lost or find the right pose, but must not report a wrong one
  const Estimate last = robot.estimate();
  if (robot.estimator.searching()) {
    EXPECT_EQ(last.health, Health::lost);
    EXPECT_EQ(last.landmarks.size(), map_.landmarks.size());
  } else {
    EXPECT_LT(robot.error_m(), 0.5);
  }
}

TEST(LampMapToStartFrom, MustHaveHeights) {
  MapSnapshot map;
  map.landmarks.resize(2);
  EXPECT_TRUE(why_unfit_for_lamp_ekf(map, lamp_rig()));
  for (MapLandmark& lamp : map.landmarks) lamp.z_map_landmark_m = 6.5;
  EXPECT_EQ(why_unfit_for_lamp_ekf(map, lamp_rig()), std::nullopt);
  map.names = MapNames::looks;
  EXPECT_TRUE(why_unfit_for_lamp_ekf(map, lamp_rig()));
}

TEST(LampMapToSave, IsNoneWithoutALamp) {
  MapSnapshot map;
  EXPECT_FALSE(LampEkfEstimator(lamp_rig(), {}).save_map(map));
}

}  // namespace
}  // namespace azimuth
