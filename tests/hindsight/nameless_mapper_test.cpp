#include "slam/hindsight/nameless_mapper.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <set>

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

}  // namespace
}  // namespace azimuth
