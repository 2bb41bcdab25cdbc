// The information in a saved map on the robot's pose at the next start.

#include <gmock/gmock.h>

#include "daemon/daemon_setup.hpp"
#include "drivers/storage/map_codec.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

TEST(SavedMapReach, GrowsWithTheAgeOfARecentMap) {
  MapSettings settings;
  settings.recent_s = 20.0;
  settings.fastest_m_per_s = 0.5;
  EXPECT_DOUBLE_EQ(reach_since(0s, settings), 1.0) << "never 0, which is anywhere";
  EXPECT_DOUBLE_EQ(reach_since(10s, settings), 6.0);
  EXPECT_DOUBLE_EQ(reach_since(20s, settings), 11.0);
}

TEST(SavedMapReach, IsAnywhereForAMapThatIsNotRecent) {
  MapSettings settings;
  settings.recent_s = 20.0;
  EXPECT_EQ(reach_since(20'001ms, settings), 0.0);
  EXPECT_EQ(reach_since(-1ms, settings), 0.0) << "of the future: the clock was set";
  settings.recent_s = 0.0;
  EXPECT_EQ(reach_since(0s, settings), 0.0) << "not wanted";
}

TEST(SavedMapReach, LimitsASearchWithinAMinuteUnlessTold) {
  EXPECT_DOUBLE_EQ(reach_since(60s, {}), 151.0);
  EXPECT_EQ(reach_since(61s, {}), 0.0);
}

/// A file with a map of landmarks that have neither identities nor kinds.
class NamelessMap : public testing::Test {
 protected:
  NamelessMap() {
    MapSnapshot map;
    for (int i = 0; i < 6; ++i)
      map.landmarks.push_back({.id = map.next_id++, .sightings = 9, .p_map_landmark_m = {1.0 * i, 2.0}});
    map.covariance.resize(3 + 2 * map.landmarks.size());
    for (std::size_t i = 0; i < map.covariance.size(); ++i) map.covariance.below(i).front() = 0.01;
    std::vector<std::byte> bytes;
    encode(map, bytes);
    EXPECT_TRUE(write_map(bytes, settings_.file));
  }

  test::TemporaryFolder folder_;
  MapSettings settings_{.file = (folder_.path() / "map.azmap").string()};
  Configuration configuration_;
};

TEST_F(NamelessMap, IsForARobotThatItsOdometerTellsWhereItIs) {
  const FileResult<SavedMap> saved = saved_map(settings_, configuration_, Rig{});
  ASSERT_TRUE(saved) << text(saved.error());
  ASSERT_TRUE(saved->loaded);
  EXPECT_TRUE(saved->needs_pose);
  EXPECT_TRUE(saved->status.unfit) << "unless that is so";
  EXPECT_THAT(saved->status.text, testing::HasSubstr("set aside"));
  EXPECT_THAT(started_from(*saved->loaded).text, testing::HasSubstr("started from its 6 landmarks"));
}

TEST_F(NamelessMap, IsForARobotThatIsToldThatItsPoseIsKnown) {
  configuration_.map.pose_known = true;
  const FileResult<SavedMap> saved = saved_map(settings_, configuration_, Rig{});
  ASSERT_TRUE(saved) << text(saved.error());
  EXPECT_TRUE(saved->loaded);
  EXPECT_FALSE(saved->needs_pose);
  EXPECT_FALSE(saved->status.unfit);
}

}  // namespace
}  // namespace azimuth
