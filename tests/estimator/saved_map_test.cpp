// EkfEstimator: maps that are saved and loaded again.

#include <cmath>
#include <gtest/gtest.h>

#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

/// The samples of `world` from `stamp`, the stamp of a set, on. That set is emptied, because it has already been used.
World after(const World& world, Stamp stamp) {
  World rest = world;
  std::erase_if(rest.bearings, [&](const BearingSet& set) { return set.stamp < stamp; });
  rest.bearings.front().clear();
  const auto next = std::ranges::find_if(rest.odometry, [&](const auto& reading) { return reading.stamp >= stamp; });
  rest.odometry.erase(rest.odometry.begin(), next - 1);
  return rest;
}

/// Two laps of the lab, and the map saved after the first lap.
class SavedMap : public testing::TestWithParam<bool> {
 protected:
  SavedMap() : scenario_(two_laps(GetParam())), world_(simulate(scenario_)), rig_(rig_of(scenario_)) {
    SimulatedDrive first(rig_, settings_);
    first.run(world_, at_s(75));
    saved_ = first.stage().save_map(map_);
    rest_ = after(world_, map_.stamp);
  }

  static Scenario two_laps(bool named) {
    Scenario scenario = lab(1, 2);
    scenario.sensor.identities = named;
    return scenario;
  }

  /// Without identities the estimator cannot confirm that the pose is right.
  static Health fine() { return GetParam() ? Health::tracking : Health::degraded; }

  SimulatedDrive start(MapMode mode, bool pose_known, double sigma_m = 0.1) const {
    return {std::make_unique<EkfEstimator>(rig_, settings_, MapStart{&map_, mode, pose_known, sigma_m, sigma_m}), rig_};
  }

  Scenario scenario_;
  World world_, rest_;
  Rig rig_;
  EkfSettings settings_;
  MapSnapshot map_;
  bool saved_ = false;
};

TEST_P(SavedMap, HoldsWhatTheEstimatorKnows) {
  ASSERT_TRUE(saved_);
  EXPECT_GE(map_.landmarks.size(), 20u);
  EXPECT_EQ(map_.covariance.size(), map_.entries());
  EXPECT_EQ(map_.names, GetParam() ? MapNames::sensor : MapNames::none);
  for (const MapLandmark& landmark : map_.landmarks) {
    EXPECT_LT(landmark.id, map_.next_id);
    EXPECT_EQ(landmark.identity == kUnknownIdentity, !GetParam());
    EXPECT_FALSE(landmark.has_height());
  }
}

TEST_P(SavedMap, IsHandedOverWithoutAllocatingOnceItsStorageHasGrown) {
  SimulatedDrive drive = start(MapMode::extend, true);
  drive.run(rest_, at_s(80));
  MapSnapshot out;
  ASSERT_TRUE(drive.stage().save_map(out));
  const std::size_t before = allocations();
  ASSERT_TRUE(drive.stage().save_map(out));
  EXPECT_EQ(allocations() - before, 0u);
}

TEST_P(SavedMap, GoesOnAsIfNothingHadHappened) {
  // WHEN one robot drives its second lap with its saved map and pose, and another one without any restart
  SimulatedDrive uninterrupted(rig_, settings_), restarted = start(MapMode::extend, true, 0.0);
  uninterrupted.run(world_);
  restarted.run(rest_);
  // THEN both agree. Only the bearings of landmarks that were no points yet are lost, and with names there are none.
  const Pose2 apart = inverse(uninterrupted.last().T_map_body) * restarted.last().T_map_body;
  EXPECT_LT(apart.position().norm(), GetParam() ? 0.003 : 0.05);
  EXPECT_LT(std::abs(apart.heading_rad), GetParam() ? 0.001 : 0.02);
  EXPECT_LT(position_error_m(world_, restarted.last()), 0.1);
  EXPECT_EQ(restarted.last().health, fine());
  EXPECT_GE(restarted.estimator().landmarks().size(), map_.landmarks.size());
}

TEST_P(SavedMap, IsKeptToTheLastBitByARobotThatOnlyLocalises) {
  SimulatedDrive drive = start(MapMode::localise, true);
  double worst_m = 0.0;
  drive.on_estimate = [&](const Estimate& estimate) {
    worst_m = std::max(worst_m, position_error_m(world_, estimate));
  };
  drive.run(rest_);
  EXPECT_LT(worst_m, 0.5);
  EXPECT_EQ(drive.last().health, fine());
  EXPECT_GT(drive.last().association.accepted, 500u);
  MapSnapshot kept;
  ASSERT_TRUE(drive.stage().save_map(kept));
  ASSERT_EQ(kept.landmarks.size(), map_.landmarks.size());
  std::size_t entry = map_.first_landmark_entry();
  for (std::size_t i = 0; i < map_.landmarks.size(); ++i) {
    EXPECT_EQ(kept.landmarks[i].id, map_.landmarks[i].id);
    EXPECT_EQ(kept.landmarks[i].p_map_landmark_m, map_.landmarks[i].p_map_landmark_m);
  }
  for (; entry < map_.entries(); ++entry)
    EXPECT_TRUE(std::ranges::equal(kept.covariance.below(entry), map_.covariance.below(entry)));
}

TEST_P(SavedMap, ForgivesARobotThatWasPushed) {
  // GIVEN a robot that was moved by some centimetres and degrees while its computer was off
  map_.T_map_body = map_.T_map_body * Pose2{0.15, -0.1, 0.1};
  SimulatedDrive drive = start(MapMode::extend, true, 0.2);
  drive.run(rest_);
  EXPECT_LT(position_error_m(world_, drive.last()), 0.3);
  EXPECT_EQ(drive.last().health, fine());
}

INSTANTIATE_TEST_SUITE_P(Landmarks, SavedMap, testing::Values(true, false),
                         [](const auto& named) { return named.param ? "WithNames" : "WithoutNames"; });

class SavedMapWithNames : public SavedMap {};

TEST_P(SavedMapWithNames, ShowsARobotThatDoesNotKnowWhereItIs) {
  for (const MapMode mode : {MapMode::localise, MapMode::extend}) {
    // GIVEN a robot that knows a map but not its pose, and that was carried far away
    map_.T_map_body = {-30.0, 20.0, 2.0};
    SimulatedDrive drive = start(mode, false);
    std::optional<Stamp> found;
    double worst_m = 0.0;
    drive.on_estimate = [&](const Estimate& estimate) {
      if (estimate.health == Health::tracking && !found) found = estimate.stamp;
      if (found) worst_m = std::max(worst_m, position_error_m(world_, estimate));
      EXPECT_TRUE(found || estimate.landmarks.size() == map_.landmarks.size());
    };
    // WHEN the robot drives and observes
    drive.run(rest_);
    // THEN it is relocalised within seconds, at its true pose
    ASSERT_TRUE(found);
    EXPECT_LT(to_seconds(*found - map_.stamp), 5.0);
    EXPECT_LT(worst_m, 0.5);
  }
}

TEST_P(SavedMapWithNames, IsLeftAloneWhileTheRobotLooksForItself) {
  EkfEstimator estimator(rig_, settings_, {.map = &map_});
  BearingSet strange;  // these bearings do not match the map
  for (int i = 0; i < 6; ++i) strange.bearings.push_back({.azimuth_rad = 0.3 * i, .identity = i});
  Estimate before, after;
  estimator.estimate(before);
  estimator.update(strange);
  estimator.estimate(after);
  EXPECT_TRUE(estimator.searching());
  EXPECT_EQ(after.health, Health::lost);
  EXPECT_EQ(after.reason, "none of the landmarks is where it should be");
  ASSERT_EQ(after.landmarks.size(), before.landmarks.size());
  for (std::size_t i = 0; i < after.landmarks.size(); ++i)
    EXPECT_EQ(after.landmarks[i].p_map_landmark_m, before.landmarks[i].p_map_landmark_m);
  MapSnapshot unwanted;
  EXPECT_FALSE(estimator.save_map(unwanted)) << "a robot that is lost has nothing to add to its map";
}

TEST_P(SavedMapWithNames, IsLeftBehindWhenItIsTooSmallToBeFoundIn) {
  MapSnapshot few;
  few.names = MapNames::sensor;
  for (int i = 0; i < settings_.relocation.bearings - 1; ++i) few.landmarks.push_back({.id = i, .identity = i});
  few.next_id = settings_.relocation.bearings;
  few.covariance.resize(few.entries());
  EXPECT_FALSE(EkfEstimator(rig_, settings_, {.map = &few}).searching()) << "it would search for ever";
  EXPECT_EQ(EkfEstimator(rig_, settings_, {.map = &few, .pose_known = true}).landmarks().size(), few.landmarks.size());
  EXPECT_TRUE(EkfEstimator(rig_, settings_, {.map = &few, .mode = MapMode::localise}).searching());
}

INSTANTIATE_TEST_SUITE_P(Named, SavedMapWithNames, testing::Values(true), [](const auto&) { return "Landmarks"; });

TEST(MapToStartFrom, MustBeOfTheRobotsKind) {
  Rig named, unnamed, features;
  named.camera.identities = true;
  features.front_end = FrontEnd::sift;
  MapSnapshot map;
  map.landmarks.resize(1);
  const auto fits = [&](MapNames names, const Rig& rig) {
    map.names = names;
    return !why_unfit_for_ekf(map, rig);
  };
  EXPECT_TRUE(fits(MapNames::none, unnamed));
  EXPECT_TRUE(fits(MapNames::sensor, named));
  EXPECT_TRUE(fits(MapNames::looks, features));
  EXPECT_FALSE(fits(MapNames::none, named));
  EXPECT_FALSE(fits(MapNames::sensor, features));
  EXPECT_FALSE(fits(MapNames::looks, unnamed));
  map.landmarks[0].z_map_landmark_m = 2.5;
  EXPECT_FALSE(fits(MapNames::none, unnamed)) << "the plane has no room for heights";
}

TEST(MapToSave, IsNoneWithoutALandmark) {
  const EkfEstimator estimator(Rig{}, EkfSettings{});
  MapSnapshot map;
  EXPECT_FALSE(estimator.save_map(map));
}

}  // namespace
}  // namespace azimuth
