// A daemon is killed while it saves the map and the odometry since that map. The next start must find a consistent pair
// of both on disk. See the table in drivers/storage/kept_odometry.hpp.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "daemon/daemon_setup.hpp"
#include "daemon/keep/map_keeper.hpp"
#include "drivers/storage/map_codec.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

using Content = std::vector<std::byte>;

constexpr Duration kKeptEpoch{1'000'000'000};

Content content_of(const fs::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return {};
  return {mapped->bytes().begin(), mapped->bytes().end()};
}

void write_content(const fs::path& file, const Content& content) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
}

Content first_half(const Content& content) {
  return {content.begin(), content.begin() + static_cast<std::ptrdiff_t>(content.size() / 2)};
}

/// Map number n of a drive.
MapSnapshot map_of(int n) {
  MapSnapshot map;
  map.stamp = Stamp{std::chrono::seconds(100 + n)};
  map.landmarks.resize(static_cast<std::size_t>(n));
  for (MapLandmark& landmark : map.landmarks) landmark.id = map.next_id++;
  map.covariance.resize(map.entries());
  return map;
}

class KilledKeeper : public testing::Test {
 protected:
  KilledKeeper() { odometer_.origin = 4; }

  /// Odometry since map n: the robot has driven `x_m` metres.
  OdometrySince since(int n, double x_m) {
    OdometrySince since;
    since.map = map_of(n).stamp;
    since.motion.T_start_end.x_m = x_m;
    since.reading.origin = odometer_.origin;
    since.reading.stamp = newest_ += Duration{100'000};
    return since;
  }
  void tell(OdometryKeeper& keeper, int n, double x_m) {
    keeper.odometer_is(odometer_);
    keeper.robot_went({since(n, x_m), {}});
  }
  fs::path records() const { return kept_odometry_file(file_); }

  /// The map and the odometry that a start would find on disk now.
  struct Found {
    std::size_t landmarks = 0;
    std::optional<double> way_m;
    friend bool operator==(const Found&, const Found&) = default;
  };
  Found found() const {
    const FileResult<LoadedMap> map = read_map(file_);
    if (!map) return {};
    const SavedOdometry odometry = saved_odometry(*map, file_, stamp_clock(kKeptEpoch));
    if (!odometry.kept) return {map->map.landmarks.size(), {}};
    return {map->map.landmarks.size(), odometry.kept->since.motion.T_start_end.x_m};
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_ / "map.azmap";
  std::vector<std::byte> bytes_;  // an encoded map
  OdometerMemory odometer_;
  Stamp newest_{Duration{200'000'000}};
};

/// Saves the map and the odometry since it in MapKeeper's order, step by step. The daemon is killed after each step and
/// in the middle of each write to a file.
class KilledStepByStep : public KilledKeeper {
 protected:
  void write_first_map() {
    encode(map_of(1), bytes_);
    ASSERT_TRUE(write_map(bytes_, file_));
    keeper_.map_is(map_of(1).stamp, map_checksum(bytes_));
  }
  /// Runs the step. Expects to find `after` when it is complete, and `before` when its write was only half done.
  void step(const std::string& what, const Found& before, const Found& after, const std::function<void()>& does) {
    Content old_records = content_of(records());
    does();
    EXPECT_EQ(found(), after) << "killed after: " << what;
    Content half = content_of(records());
    if (half == old_records) return;
    old_records.resize(half.size());
    const Content whole = half;
    const auto size = static_cast<std::ptrdiff_t>(record_size());
    const auto changed = std::ranges::mismatch(half, old_records).in1 - half.begin();
    const std::ptrdiff_t begin = changed / size * size;
    std::fill(half.begin() + begin + size / 2, half.begin() + begin + size, std::byte{7});
    write_content(records(), half);
    EXPECT_EQ(found(), before) << "killed half way through: " << what;
    write_content(records(), whole);
  }
  void write_way(int n, double x_m, const Found& before) {
    step("the way since map " + std::to_string(n), before, {static_cast<std::size_t>(n), x_m}, [&] {
      tell(keeper_, n, x_m);
      keeper_.write();
    });
  }
  /// Replaces map `n` by the next map. `was` is on the disk before.
  void next_map(int n, const Found& was) {
    const MapSnapshot map = map_of(n + 1);
    const Found is{static_cast<std::size_t>(n + 1), 0.01};
    const fs::path fresh = file_.string() + ".new";
    encode(map, bytes_);
    step("the news of the way since the new map", was, was, [&] {
      tell(keeper_, n + 1, 0.01);
      keeper_.write();
    });
    step("its record", was, was, [&] { keeper_.map_comes(map.stamp, map_checksum(bytes_)); });
    step("half of it beside the old one", was, was, [&] { write_content(fresh, first_half(bytes_)); });
    step("all of it", was, was, [&] { write_content(fresh, bytes_); });
    step("the old one has another name", was, was, [&] { fs::rename(file_, previous_map(file_)); });
    step("the new one has its own", was, is, [&] { fs::rename(fresh, file_); });
    step("that is known", is, is, [&] { keeper_.map_is(map.stamp, map_checksum(bytes_)); });
  }
  std::size_t record_size() const {
    Content record;
    encode(KeptOdometry{}, record);
    return record.size();
  }

  OdometryKeeper keeper_{file_, stamp_clock(kKeptEpoch)};
};

TEST_F(KilledStepByStep, LeavesAMapWithTheWaySinceIt) {
  write_first_map();
  write_way(1, 0.5, {1, {}});
  write_way(1, 0.6, {1, 0.5});
  write_way(1, 0.7, {1, 0.6});
  next_map(1, {1, 0.7});
  write_way(2, 0.2, {2, 0.01});
  write_way(2, 0.3, {2, 0.2});
  next_map(2, {2, 0.3});
  next_map(3, {3, 0.01});
  write_way(4, 0.4, {4, 0.01});
}

TEST_F(KilledStepByStep, LeavesItBeforeTheNextStartHasHeardOfTheRobot) {
  write_first_map();
  write_way(1, 0.5, {1, {}});
  next_map(1, {1, 0.5});
  for (int start = 1; start <= 3; ++start) {
    step("start", {2, 0.01}, {2, 0.01}, [&] { keeper_ = OdometryKeeper(file_, stamp_clock(kKeptEpoch)); });
    step("its map", {2, 0.01}, {2, 0.01}, [&] { keeper_.map_is(map_of(2).stamp, map_checksum(bytes_)); });
    step("its odometer", {2, 0.01}, {2, 0.01}, [&] { keeper_.odometer_is(odometer_); });
    step("what is written of that", {2, 0.01}, {2, 0.01}, [&] { keeper_.write(); });
  }
  write_way(2, 0.8, {2, 0.01});
}

/// Saves through MapKeeper. The test cannot kill it half way, but it can make its file operations fail.
class KeeperInTrouble : public KilledKeeper {
 protected:
  MapKeeper keeper(bool saves = true) const {
    return {{file_.string(), 30.0}, {}, saves, OdometryKeeper(file_, stamp_clock(kKeptEpoch))};
  }
  void save(MapKeeper& keeper, int n, double x_m) {
    tell(*keeper.odometry(), n, x_m);
    keeper.odometry()->write();
    keeper.save(map_of(n));
  }
};

TEST_F(KeeperInTrouble, HasTheRecordOnTheDiskBeforeTheMapAndKeepsTheOneBefore) {
  MapKeeper maps = keeper();
  save(maps, 1, 0.1);
  EXPECT_EQ(found(), (Found{1, 0.1})) << "with the map";
  // GIVEN a file system that does not let the old map become the previous one
  fs::create_directories(previous_map(file_) / "in the way");
  for (const int n : {2, 3}) {
    save(maps, n, 0.2);
    EXPECT_TRUE(maps.status().trouble);
    EXPECT_EQ(found(), (Found{1, 0.1})) << "the old map with its own way";
    encode(map_of(n), bytes_);
    const KeptRecords kept = read_kept_odometry(records());
    EXPECT_TRUE(std::ranges::any_of(kept, [&](const auto& record) {
      return record && record->map_checksum == map_checksum(bytes_);
    })) << "and that of the map that should have been";
  }
  fs::remove_all(previous_map(file_));
  save(maps, 4, 0.3);
  EXPECT_EQ(found(), (Found{4, 0.3}));
}

TEST_F(KeeperInTrouble, GoesOnWithTheWaySinceTheMapThatIsOnTheDisk) {
  MapKeeper maps = keeper();
  save(maps, 1, 0.1);
  // GIVEN a full disk, imitated by a file that cannot be created
  const fs::path in_the_way = file_.string() + ".new";
  const auto went = [&](double since_kept_m, int made, double since_made_m) {
    maps.odometry()->odometer_is(odometer_);
    maps.odometry()->robot_went({since(1, since_kept_m), since(made, since_made_m)});
    maps.odometry()->write();
  };
  // WHEN several maps in a row cannot be written while the robot drives on
  double way_m = 0.1;
  for (const int n : {2, 3, 4}) {
    fs::create_directories(in_the_way);
    went(way_m += 0.5, n, 0.0);
    EXPECT_FALSE(maps.save(map_of(n)));
    EXPECT_EQ(found(), (Found{1, way_m})) << n;
    went(way_m += 0.5, n, 0.5);
    EXPECT_EQ(found(), (Found{1, way_m})) << "several times a second, as ever";
    EXPECT_TRUE(maps.odometry()->knows_way());
  }
  // THEN the disk holds a consistent pair of map and odometry at any time, also once there is room again
  fs::remove_all(in_the_way);
  went(way_m, 5, 0.0);
  EXPECT_TRUE(maps.save(map_of(5)));
  EXPECT_EQ(found(), (Found{5, 0.0}));
  went(9.0, 5, 0.7);
  EXPECT_EQ(found(), (Found{5, 0.7}));
}

TEST_F(KeeperInTrouble, ForgetsInPlaceWhereAFullDiskHasNoRoomForMore) {
  MapKeeper maps = keeper();
  save(maps, 1, 0.1);
  save(maps, 2, 0.2);
  const auto size = fs::file_size(records());
  maps.odometry()->robot_went({});
  EXPECT_EQ(found(), (Found{2, {}}));
  EXPECT_EQ(fs::file_size(records()), size);
  tell(*maps.odometry(), 2, 0.4);
  maps.odometry()->write();
  EXPECT_EQ(found(), (Found{2, 0.4}));
}

TEST_F(KeeperInTrouble, KeepsWhereTheRobotIsBesideAMapThatStaysAsItIs) {
  // GIVEN a map and a robot that has been localised on it
  encode(map_of(2), bytes_);
  ASSERT_TRUE(write_map(bytes_, file_));
  const Content before = content_of(file_);
  MapSnapshot located = map_of(2);
  located.stamp += Duration{60'000'000};
  located.T_map_body.x_m = 3.0;
  MapKeeper maps = keeper(false);
  EXPECT_FALSE(maps.is_due(MapKeeper::Clock::time_point{}));
  EXPECT_TRUE(maps.is_due(MapKeeper::Clock::time_point{std::chrono::seconds(4)})) << "nobody knows the way yet";
  OdometrySince way = since(2, 0.5);
  way.map = located.stamp;
  maps.odometry()->odometer_is(odometer_);
  maps.odometry()->robot_went({way, {}});
  // WHEN the robot's pose is saved
  maps.save(located);
  // THEN the map file is unchanged, and the next start knows both the map and the pose
  EXPECT_EQ(content_of(file_), before);
  EXPECT_FALSE(fs::exists(previous_map(file_)));
  DaemonSetup setup;
  setup.daemon.map.file = file_.string();
  setup.origin.epoch_minus_monotonic = kKeptEpoch;
  struct : Source {
    const char* name() const override { return "odometer"; }
    bool turn(Doorbell&, SourceWires&) override { return false; }
    void restore(const OdometerMemory&) override {}
  } odometer;
  setup.origin.sources.push_back(std::make_unique<decltype(odometer)>(odometer));
  setup.saved.loaded = *read_map(file_);
  find_odometry(setup);
  EXPECT_FALSE(setup.odometry.kept) << "a robot that maps begins with the map itself";
  setup.configuration.map.mode = MapMode::localise;
  find_odometry(setup);
  ASSERT_TRUE(setup.odometry.kept) << setup.odometry.text;
  EXPECT_EQ(setup.odometry.kept->since.motion.T_start_end.x_m, 0.5);
  EXPECT_EQ(setup.saved.loaded->map.T_map_body.x_m, 3.0);
  EXPECT_TRUE(setup.configuration.map.asks_odometry);
}

TEST_F(KeeperInTrouble, DoesNotTakeAnotherMapForTheOneThatStaysAsItIs) {
  MapKeeper maps = keeper(false);
  save(maps, 2, 0.5);
  LoadedMap map;
  map.map = map_of(2);
  EXPECT_TRUE(map_with_robot(map, file_));
  map.map.landmarks[1].p_map_landmark_m.x() = 1e-9;
  EXPECT_FALSE(map_with_robot(map, file_));
  map.map = map_of(3);
  EXPECT_FALSE(map_with_robot(map, file_));
  fs::remove(located_map(file_));
  map.map = map_of(2);
  EXPECT_FALSE(map_with_robot(map, file_));
}

}  // namespace
}  // namespace azimuth
