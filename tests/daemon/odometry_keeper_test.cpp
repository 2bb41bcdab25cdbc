// The odometry that is saved for the next start, and what the next start reads from it.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "daemon/daemon_setup.hpp"
#include "daemon/keep/map_keeper.hpp"
#include "drivers/storage/map_codec.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

constexpr Duration kEpoch{1'000'000'000};

class OdometryKeeping : public testing::Test {
 protected:
  OdometryKeeping() {
    map_.map.stamp = stamp_from_us(5'000'000);
    map_.map.covariance.resize(map_.map.entries());
    encode(map_.map, map_.bytes);
    keeper_.map_is(map_.map.stamp, map_checksum(map_.bytes));
    odometer_.odometer = "pioneer /dev/pioneer";
    odometer_.origin = since_.reading.origin = 4;
    since_.map = map_.map.stamp;
    since_.motion.T_start_end = {1.0, 2.0, 0.5};
  }
  /// Saves the odometry with a newer reading than before.
  void keep() {
    since_.reading.stamp += Duration{1000};
    keeper_.odometer_is(odometer_);
    keeper_.robot_went({since_, {}});
    keeper_.write();
  }
  SavedOdometry saved() const { return saved_odometry(map_, file_, stamp_clock(kEpoch)); }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "map.azmap";
  OdometryKeeper keeper_{file_, stamp_clock(kEpoch)};
  LoadedMap map_;
  OdometerMemory odometer_;
  OdometrySince since_;
};

TEST_F(OdometryKeeping, HoldsTheNewestOfBoth) {
  for (const double x_m : {1.5, 2.5, 3.5}) {
    odometer_.T_odom_body.x_m = since_.motion.T_start_end.x_m = x_m;
    keep();
    const SavedOdometry next = saved();
    ASSERT_TRUE(next.kept) << next.text;
    EXPECT_EQ(next.kept->odometer, odometer_);
    EXPECT_EQ(next.kept->since.motion.T_start_end, since_.motion.T_start_end);
  }
}

TEST_F(OdometryKeeping, HoldsNothingThatDoesNotBelongTogether) {
  ++odometer_.origin;
  keep();
  EXPECT_FALSE(saved().kept) << "the odometer began anew, and the estimator does not know yet";
  --odometer_.origin;
  since_.map += Duration{1};
  keep();
  EXPECT_FALSE(saved().kept) << "since a map that is not on the disk yet";
}

TEST_F(OdometryKeeping, ForgetsWhenNobodyKnowsHowTheRobotWent) {
  keep();
  keep();
  keeper_.robot_went({});
  keeper_.write();
  EXPECT_FALSE(saved().kept);
  EXPECT_EQ(saved().text, "where the robot went since then is not known: no odometry was kept");
  keep();
  EXPECT_TRUE(saved().kept) << "again";
}

TEST_F(OdometryKeeping, ForgetsWhenTheOdometerBeginsAnew) {
  keep();
  keep();
  keeper_.odometer_is(odometer_);
  EXPECT_TRUE(saved().kept);
  ++odometer_.origin;
  keeper_.odometer_is(odometer_);
  EXPECT_FALSE(saved().kept);
}

TEST_F(OdometryKeeping, KeepsWhatTheStartBeforeLeftUntilThereIsSomethingNewer) {
  keep();
  keep();
  const OdometrySince left = since_;
  OdometryKeeper next(file_, stamp_clock(kEpoch));
  EXPECT_TRUE(saved().kept) << "killed at once";
  next.map_is(map_.map.stamp, map_checksum(map_.bytes));
  next.odometer_is(odometer_);
  next.write();
  ASSERT_TRUE(saved().kept) << "killed before the first reading";
  EXPECT_EQ(saved().kept->since.reading.stamp, left.reading.stamp);
  since_.reading.stamp += Duration{500};
  next.robot_went({since_, {}});
  next.write();
  EXPECT_EQ(saved().kept->since.reading.stamp, since_.reading.stamp);
}

TEST_F(OdometryKeeping, ForgetsWhatTheStartBeforeLeftWhenItDoesNotGoOn) {
  keep();
  OdometryKeeper next(file_, stamp_clock(kEpoch));
  next.robot_went({});
  EXPECT_FALSE(saved().kept);
}

TEST_F(OdometryKeeping, IsOfNoUseForAnotherMap) {
  keep();
  map_.map.next_id = 17;
  encode(map_.map, map_.bytes);
  const SavedOdometry next = saved();
  EXPECT_FALSE(next.kept);
  EXPECT_EQ(next.text,
            "where the robot went since then is not known: the odometry that was kept belongs to another map");
}

TEST_F(OdometryKeeping, IsOfNoUseAfterABoot) {
  StampClock before = stamp_clock(kEpoch);
  EXPECT_FALSE(before.boot.empty());
  before.boot = "another";
  OdometryKeeper old(file_, before);
  old.map_is(map_.map.stamp, map_checksum(map_.bytes));
  old.odometer_is(odometer_);
  old.robot_went({since_, {}});
  old.write();
  EXPECT_EQ(saved().text, "where the robot went since then is not known: the machine was switched off, or slept");
}

TEST(MapKeeping, IsDueSoonWhenOnlyANewMapWouldTellWhereTheRobotIs) {
  using namespace std::chrono_literals;
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "map.azmap";
  MapSettings settings;
  settings.file = file.string();
  MapKeeper plain(settings, {}, true), keeper(settings, {}, true, OdometryKeeper(file, stamp_clock(kEpoch)));
  MapKeeper::Clock::time_point now{1h};
  EXPECT_FALSE(plain.is_due(now) || keeper.is_due(now));
  now += 4s;
  EXPECT_FALSE(plain.is_due(now));
  EXPECT_TRUE(keeper.is_due(now));
  EXPECT_FALSE(keeper.is_due(now));
  keeper.odometry()->robot_went({OdometrySince{}, {}});
  now += 20s;
  EXPECT_FALSE(keeper.is_due(now));
  keeper.odometry()->robot_went({});
  EXPECT_TRUE(keeper.is_due(now));
  now += 30s;
  EXPECT_TRUE(plain.is_due(now));
}

// A daemon that is repeatedly killed before a save interval has passed must not start the interval anew: it would never
// save, and the odometry since its map would become too uncertain to use.
TEST(MapKeeping, CountsFromTheMapThatAStartBeforeLeftThoughTheWayIsKnownALittleLater) {
  using namespace std::chrono_literals;
  const test::TemporaryFolder folder;
  MapSettings settings;
  settings.file = (folder.path() / "map.azmap").string();
  std::ofstream(settings.file) << "a map";
  std::filesystem::last_write_time(settings.file, std::filesystem::file_time_type::clock::now() - 1h);
  MapKeeper keeper(settings, {}, true, OdometryKeeper(settings.file, stamp_clock(kEpoch)));
  const MapKeeper::Clock::time_point start{1h};
  EXPECT_FALSE(keeper.is_due(start)) << "no odometry yet";
  keeper.odometry()->robot_went({OdometrySince{}, {}});
  EXPECT_FALSE(keeper.is_due(start + 900ms));
  EXPECT_TRUE(keeper.is_due(start + 1s));
  EXPECT_FALSE(keeper.is_due(start + 20s));
}

}  // namespace
}  // namespace azimuth
