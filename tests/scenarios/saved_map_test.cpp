// A robot that starts from a map of an earlier drive, among features identified by descriptors.

#include <gtest/gtest.h>

#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/feature_world.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

class SavedFeatureMap : public testing::TestWithParam<MapMode> {};

TEST_P(SavedFeatureMap, TellsARobotWhereItIs) {
  // GIVEN the map of a room full of features, and a robot with an unknown pose in the room
  const FeatureWorld world = feature_world(1);
  Rig rig = rig_of(world.run);
  rig.front_end = FrontEnd::sift;
  rig.camera.identities = false;
  const ReplayResult first = replay(world.run, rig, make_ekf_estimator(rig, {}), StageSettings{});
  ASSERT_TRUE(first.map);
  EXPECT_GT(first.map->views.size(), first.map->landmarks.size());
  azimuth::Run later = world.run;  // the second half of the drive
  const Stamp middle = later.odometry[later.odometry.size() / 2].stamp;
  std::erase_if(later.odometry, [&](const OdometryReading& reading) { return reading.stamp < middle; });
  std::erase_if(later.bearings, [&](const BearingSet& set) { return set.stamp < middle; });
  std::erase_if(later.truth, [&](const TruthPose& pose) { return pose.stamp < middle; });
  // WHEN it starts from the map in the middle of the drive
  const MapStart start{.map = &*first.map, .mode = GetParam()};
  const ReplayResult second = replay(later, rig, make_ekf_estimator(rig, {}, start), StageSettings{});
  // THEN it relocalises with the first good images, at the pose of the first drive
  const auto found = std::ranges::find_if(second.estimates, [](const EstimateRecord& estimate) {
    return estimate.covariance.topLeftCorner<2, 2>().trace() < 1.0;
  });
  ASSERT_NE(found, second.estimates.end());
  EXPECT_LT(to_seconds(found->stamp - middle), 10.0);
  double worst_m = 0.0;
  for (auto estimate = found; estimate != second.estimates.end(); ++estimate) {
    const auto same = std::ranges::find(first.estimates, estimate->stamp, &EstimateRecord::stamp);
    ASSERT_NE(same, first.estimates.end());
    worst_m = std::max(worst_m, (same->T_map_body.position() - estimate->T_map_body.position()).norm());
  }
  EXPECT_LT(worst_m, 0.3);
  EXPECT_LT(world.wrong(second.sightings), second.sightings.size() / 50);
  ASSERT_TRUE(second.map);
  if (GetParam() == MapMode::localise) {
    EXPECT_EQ(second.map->views, first.map->views);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, SavedFeatureMap, testing::Values(MapMode::localise, MapMode::extend),
                         test::PrintedName());

}  // namespace
}  // namespace azimuth
