#include "slam/hindsight/nameless_mapper.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <set>

#include "slam/hindsight/smoother_estimator.hpp"
#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

struct Told {
  std::set<std::int64_t> ids;
  std::uint64_t sightings = 0;
};

Told told(const Mapper& mapper) {
  Told all;
  for (const HindsightLandmark& landmark : mapper.landmarks()) {
    all.ids.insert(landmark.id);
    all.sightings += landmark.sightings;
  }
  return all;
}

TEST(NamelessMapper, LandmarksKeepIdAndSightingsWhenTheirFirstImagesAreForgotten) {
  NamelessSettings settings;
  settings.beam.hypothesis = world_settings();
  settings.beam.members = 2;
  settings.max_keyframes = 60;
  NamelessMapper mapper(settings, std::make_unique<InTurn>());
  NamelessWorld world(ring_of_landmarks());
  int forgettings = 0;
  for (int i = 0; i < 150; ++i) {
    if (i > 0) mapper.predict(world.motion(on_circle(i - 1), on_circle(i)));
    BearingSet set;
    set.stamp = Stamp(duration_from_seconds(i));
    for (const NamelessSighting& s : world.sightings(on_circle(i), 6.0))
      set.bearings.push_back({.azimuth_rad = s.azimuth_rad});
    const Told before = told(mapper);
    const std::size_t kept_before = mapper.numbers().size();
    const std::int64_t next_id = mapper.next_id();
    mapper.update(set);
    if (mapper.numbers().size() >= kept_before) continue;
    ++forgettings;
    const Told after = told(mapper);
    for (const std::int64_t id : after.ids)
      EXPECT_TRUE(before.ids.contains(id) || id >= next_id) << id << ", image " << i;
    EXPECT_GE(after.ids.size() + 1, before.ids.size());
    EXPECT_GE(after.sightings + 2, before.sightings);
    EXPECT_FALSE(mapper.kept_pose(mapper.anchor() + 1));
    EXPECT_TRUE(mapper.kept_pose(0) && mapper.kept_pose(mapper.anchor()));
  }
  EXPECT_GE(forgettings, 5);
}

TEST(NamelessMapper, GoesOnFromWhereTheRobotIsPut) {
  NamelessSettings settings;
  settings.beam.hypothesis = world_settings();
  settings.beam.members = 4;
  NamelessMapper mapper(settings, std::make_unique<InTurn>());
  NamelessWorld world(ring_of_landmarks());
  const auto see = [&](int i, double at_s) {
    BearingSet set;
    set.stamp = Stamp(duration_from_seconds(at_s));
    for (const NamelessSighting& s : world.sightings(on_circle(i), 6.0))
      set.bearings.push_back({.azimuth_rad = s.azimuth_rad});
    mapper.update(set);
  };
  constexpr int kImages = 40, kAgo = 12;
  for (int i = 0; i < kImages; ++i) {
    if (i > 0) mapper.predict(world.motion(on_circle(i - 1), on_circle(i)));
    see(i, i);
  }
  const std::size_t landmarks = mapper.landmarks().size();

  // The robot is carried back, and odometry does not notice.
  const Pose2 T_map_world = mapper.pose().T_map_body * inverse(on_circle(kImages - 1));
  const Pose2 there = T_map_world * on_circle(kImages - kAgo);
  mapper.place({there, 1e-3 * Eigen::Matrix3d::Identity()});
  EXPECT_LT((inverse(there) * mapper.pose().T_map_body).position().norm(), 0.01);  // mean over all members
  for (int i = 0; i < kAgo; ++i) {
    const int at = kImages - kAgo + i;
    if (i > 0) mapper.predict(world.motion(on_circle(at - 1), on_circle(at)));
    see(at, kImages + i);
  }
  const Pose2 off = inverse(T_map_world * on_circle(kImages - 1)) * mapper.pose().T_map_body;
  EXPECT_LT(off.position().norm(), 0.15);
  EXPECT_LT(std::abs(off.heading_rad), 0.05);
  EXPECT_EQ(mapper.landmarks().size(), landmarks);
}

TEST(UsualOdds, SpeakOfAnImageWhereNearlyAllSpeakForThePlace) {
  UsualOdds steady, changing;
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(steady.nearly_all_positive(), i >= 20) << i;
    steady.add(10.0 + (i % 2 == 0 ? 3.0 : -3.0));
    changing.add(4.0 + (i % 2 == 0 ? 5.0 : -5.0));
  }
  EXPECT_NEAR(steady.mean(), 10.0, 0.2);
  EXPECT_FALSE(changing.nearly_all_positive());
  for (int i = 0; i < 100; ++i) steady.add(-5.0);
  EXPECT_FALSE(steady.nearly_all_positive());
}

}  // namespace
}  // namespace azimuth
