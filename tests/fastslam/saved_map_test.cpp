// FastSlamEstimator: saving and loading maps of lamps in space, its own maps and those of the EKF over lamps.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "drivers/storage/map_codec.hpp"
#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/particles/fastslam_estimator.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/driven_lamps.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kSavedAt = 160;  // number of images, more than a round
constexpr std::size_t kCarriedTo = 210;
constexpr double kIrregular_m = 0.8;

using FastSlamRobot = test::DrivenLamps<FastSlamEstimator>;
using LampEkfRobot = test::DrivenLamps<LampEkfEstimator>;

FastSlamRobot robot_of(const LampRun& run, const MapStart& start = {}, std::size_t first = 0) {
  return {run, FastSlamEstimator(run.rig, {}, start), first};
}

class SavedFastSlamMap : public testing::Test {
 protected:
  SavedFastSlamMap() : run_(simulated_hall(4, kIrregular_m)) {
    FastSlamRobot first = robot_of(run_);
    first.to(kSavedAt);
    saved_ = first.estimator.save_map(map_);
  }

  /// Drives to the end of the run. After relocalisation the pose must always be near the truth and agree with its
  /// covariance.
  template <class Robot>
  void expect_at_home(Robot& robot) {
    double worst_m = 0.0, nees = 0.0, found_after_m = 0.0;
    int images = 0;
    while (robot.next < run_.sets.size()) {
      if (robot.estimator.searching()) found_after_m += run_.motions[robot.next].path_m;
      robot.step();
      if (robot.estimator.searching()) {
        EXPECT_EQ(robot.estimate().health, Health::lost);
        continue;
      }
      worst_m = std::max(worst_m, robot.error_m());
      nees += robot.nees();
      ++images;
    }
    fmt::print("at most {:.3f} m off, ANEES {:.2f} in {} images; searched for {:.2f} m\n", worst_m, nees / images,
               images, found_after_m);
    EXPECT_LT(found_after_m, 5.0);
    EXPECT_LT(worst_m, 0.6);
    EXPECT_LT(nees / images, 10.0);
    EXPECT_EQ(robot.estimate().health, Health::tracking) << robot.estimate().reason;
  }

  LampRun run_;
  MapSnapshot map_;
  bool saved_ = false;
};

TEST_F(SavedFastSlamMap, HoldsLampsInSpaceWithTheirJointCovariance) {
  ASSERT_TRUE(saved_);
  EXPECT_EQ(map_.landmarks.size(), run_.lamps.size());
  EXPECT_EQ(map_.covariance.size(), map_.entries());
  EXPECT_EQ(map_.entries(), 3 + 3 * map_.landmarks.size());
  EXPECT_EQ(map_.names, MapNames::none);
  std::size_t height = map_.first_landmark_entry() + 2;
  for (const MapLandmark& lamp : map_.landmarks) {
    EXPECT_LT(lamp.id, map_.next_id);
    EXPECT_GT(lamp.sightings, 3u);
    EXPECT_LT(std::abs(lamp.z_map_landmark_m - 6.5), 4.0 * std::sqrt(map_.covariance(height, height)) + 0.01);
    height += 3;
  }
}

TEST_F(SavedFastSlamMap, ComesBackFromAFile) {
  ASSERT_TRUE(saved_);
  std::vector<std::byte> file;
  ASSERT_EQ(implausible(map_), std::nullopt);
  encode(map_, file);
  MapSnapshot loaded;
  ASSERT_EQ(decode_map(file, loaded), std::nullopt);
  // A map that is saved again at once is unchanged.
  FastSlamRobot robot =
      robot_of(run_, {.map = &loaded, .pose_known = true, .sigma_position_m = 0.0, .sigma_heading_rad = 0.0}, kSavedAt);
  MapSnapshot again;
  ASSERT_TRUE(robot.estimator.save_map(again));
  EXPECT_EQ(again.covariance, map_.covariance);
  EXPECT_EQ(again.T_map_body.vector(), map_.T_map_body.vector());
  EXPECT_EQ(again.next_id, map_.next_id);
  test::expect_same_lamps(again, map_);
  expect_at_home(robot);
  EXPECT_EQ(robot.estimate().landmarks.size(), run_.lamps.size());
}

TEST_F(SavedFastSlamMap, IsKeptToTheLastBitByARobotThatOnlyLocalises) {
  FastSlamRobot robot = robot_of(run_, {.map = &map_, .mode = MapMode::localise, .pose_known = true}, kSavedAt);
  expect_at_home(robot);
  EXPECT_GT(robot.estimate().association.accepted, 500u);
  MapSnapshot kept;
  ASSERT_TRUE(robot.estimator.save_map(kept));
  test::expect_same_lamps(kept, map_);
}

TEST_F(SavedFastSlamMap, ForgivesARobotThatWasPushed) {
  map_.T_map_body = map_.T_map_body * Pose2{0.2, -0.2, 0.15};
  FastSlamRobot robot = robot_of(run_, {.map = &map_, .pose_known = true}, kSavedAt);
  expect_at_home(robot);
}

TEST_F(SavedFastSlamMap, ShowsARobotThatDoesNotKnowWhereItIs) {
  for (const MapMode mode : {MapMode::localise, MapMode::extend}) {
    FastSlamRobot robot = robot_of(run_, {.map = &map_, .mode = mode}, kCarriedTo);
    ASSERT_TRUE(robot.estimator.searching());
    MapSnapshot unwanted;
    EXPECT_FALSE(robot.estimator.save_map(unwanted)) << "a robot that is lost has nothing to add to its map";
    expect_at_home(robot);
    EXPECT_FALSE(robot.estimator.searching());
    MapSnapshot kept;
    ASSERT_TRUE(robot.estimator.save_map(kept));
    EXPECT_EQ(kept.landmarks.size(), map_.landmarks.size());
    if (mode == MapMode::localise) test::expect_same_lamps(kept, map_);
  }
}

TEST_F(SavedFastSlamMap, IsOneForTheEkfOverLamps) {
  ASSERT_EQ(why_unfit_for_lamp_ekf(map_, run_.rig), std::nullopt);
  LampEkfRobot knowing(run_, LampEkfEstimator(run_.rig, {}, {.map = &map_, .pose_known = true}), kSavedAt);
  expect_at_home(knowing);
  LampEkfRobot lost(run_, LampEkfEstimator(run_.rig, {}, {.map = &map_}), kCarriedTo);
  expect_at_home(lost);
}

TEST_F(SavedFastSlamMap, MayBeOneOfTheEkfOverLamps) {
  LampEkfRobot first(run_, LampEkfEstimator(run_.rig, {}));
  first.to(kSavedAt);
  ASSERT_TRUE(first.estimator.save_map(map_));
  ASSERT_EQ(why_unfit_for_fastslam(map_, run_.rig, {}), std::nullopt);
  FastSlamRobot knowing = robot_of(run_, {.map = &map_, .pose_known = true}, kSavedAt);
  expect_at_home(knowing);
  FastSlamRobot lost = robot_of(run_, {.map = &map_, .mode = MapMode::localise}, kCarriedTo);
  expect_at_home(lost);
  MapSnapshot kept;
  ASSERT_TRUE(lost.estimator.save_map(kept));
  test::expect_same_lamps(kept, map_);
}

TEST_F(SavedFastSlamMap, WaitsForWhatTheOdometrySays) {
  const MapStart start{.map = &map_, .asks_odometry = true};
  FastSlamRobot goes_on = robot_of(run_, start, kSavedAt), begins = robot_of(run_, start, kSavedAt);
  EXPECT_TRUE(goes_on.estimator.odometry_begins(true));
  EXPECT_FALSE(goes_on.estimator.searching());
  expect_at_home(goes_on);
  EXPECT_FALSE(begins.estimator.odometry_begins(false));
  EXPECT_TRUE(begins.estimator.searching());
}

TEST_F(SavedFastSlamMap, IsHandedOverWithoutAllocatingOnceItsStorageHasGrown) {
  FastSlamRobot robot = robot_of(run_, {.map = &map_, .pose_known = true}, kSavedAt);
  MapSnapshot out;
  ASSERT_TRUE(robot.estimator.save_map(out));
  const std::size_t before = allocations();
  ASSERT_TRUE(robot.estimator.save_map(out));
  EXPECT_EQ(allocations() - before, 0u);
}

TEST(FastSlamMapToStartFrom, MustBeOfPointsInSpaceAndNotTooMany) {
  MapSnapshot map;
  map.landmarks.resize(2);
  EXPECT_TRUE(why_unfit_for_fastslam(map, lamp_rig(), {}));
  for (MapLandmark& lamp : map.landmarks) lamp.z_map_landmark_m = 6.5;
  EXPECT_EQ(why_unfit_for_fastslam(map, lamp_rig(), {}), std::nullopt);
  FastSlamSettings small;
  small.max_landmarks = 1;
  EXPECT_TRUE(why_unfit_for_fastslam(map, lamp_rig(), small));
  map.names = MapNames::looks;
  EXPECT_TRUE(why_unfit_for_fastslam(map, lamp_rig(), {}));
}

TEST(FastSlamMapToSave, IsNoneWithoutALamp) {
  MapSnapshot map;
  EXPECT_FALSE(FastSlamEstimator(lamp_rig(), {}).save_map(map));
}

}  // namespace
}  // namespace azimuth
