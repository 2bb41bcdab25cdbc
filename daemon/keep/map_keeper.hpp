#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/unique_fd.hpp"
#include "daemon/keep/map_settings.hpp"
#include "drivers/storage/kept_odometry.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The clock of this process's stamps.
StampClock stamp_clock(Duration epoch_minus_monotonic);

/// Keeps the odometry from which the next start computes the pose of the robot (drivers/storage/kept_odometry.hpp),
/// beside the map. The odometer knows how it counts, and the estimator knows the motion of the robot since the map was
/// saved. A failed write is tried again with the next news; without the record, the next start needs a
/// relocalisation.
///
/// The record of an earlier start is kept until there is a newer one. It is valid as long as the odometer continues to
/// count.
///
/// Thread contract: thread-bound; not for real-time threads.
class OdometryKeeper {
 public:
  OdometryKeeper(const std::filesystem::path& map, StampClock clock);

  /// Names the map on the disk. The record kept for this map is not overwritten before there is a newer one.
  void map_is(Stamp stamp, std::uint32_t checksum);
  /// Announces a map that will replace the one on the disk, unless writing it fails, for example on a full disk. The
  /// motion since the new map is kept beside the record of the old map, which is updated further.
  void map_comes(Stamp stamp, std::uint32_t checksum);
  /// Takes the odometer's state. A record of another origin is then useless.
  void odometer_is(const OdometerMemory& memory);
  /// Takes the motion since the saved map and since the newest map. If both are empty, the motion is unknown.
  void robot_went(const OdometryWays& ways);
  /// True: the motion since the map on the disk is known.
  bool knows_way() const { return map_ ? way_since(map_->stamp) != nullptr : ways_.since_map.has_value(); }

  /// Writes the newest state of odometer and motion to the disk, if both belong to the same origin and to the map.
  void write();
  /// Removes the records, because no start can continue from them.
  void forget();

 private:
  struct MapName {
    Stamp stamp;
    std::uint32_t checksum;
  };
  /// The contents of a record in the file.
  struct Record {
    std::uint32_t map_checksum;
    std::uint32_t origin;  ///< origin of the odometry
  };
  const OdometrySince* way_since(Stamp map) const;
  std::size_t other() const { return 1 - newest_; }
  bool put(const MapName& map);

  std::filesystem::path file_;
  UniqueFd fd_;
  std::optional<MapName> map_;
  std::array<std::optional<Record>, 2> records_;  // the records in the file
  // Index in records_ of the newest record for the map on the disk.
  std::size_t newest_ = 0;
  OdometryWays ways_;
  bool knows_odometer_ = false;
  KeptOdometry kept_;  // the record that is written next
  std::vector<std::byte> bytes_;
};

/// The state of the saved map.
struct MapKeeperStatus {
  std::string text;      ///< what happened to the last map, for a person
  bool trouble = false;  ///< the map could not be loaded or saved
  /// The map on the disk cannot be started from. It is renamed before another map is saved.
  bool unfit = false;
  std::int64_t written_us = 0;  ///< when the map on the disk was written [us since the Unix epoch]; 0: there is none
  std::uint64_t saved = 0;      ///< maps saved since the start
  std::uint64_t failed = 0;     ///< failed attempts since the start
};

/// Saves maps and decides when the next save is due. An implausible map does not overwrite a good one. Trouble with the
/// disk is logged once, and the save is tried again after the next interval.
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). save() allocates.
class MapKeeper {
 public:
  using Clock = std::chrono::steady_clock;

  /// `start` tells what happened to the map that was to be loaded. Without `saves` the map file is not changed, and the
  /// pose of the robot on the map goes into the file located_map(). `odometry` is kept beside the map. A played
  /// recording has none, because its robot is not at the same place when it is played again; without `odometry` the
  /// file located_map() is not written either.
  MapKeeper(MapSettings settings, MapKeeperStatus start, bool saves, std::optional<OdometryKeeper> odometry = {});

  /// True: an interval has passed since the last save. The save of an earlier process counts as well. Otherwise a
  /// daemon that is killed again and again would never save, and the motion since its map would become too long to be
  /// used. Without a map the interval starts at the first call. The interval is short when the motion since the last
  /// map is unknown, and after a map that was empty.
  bool is_due(Clock::time_point now);

  /// Writes the map to the disk. False: the map was not written, or is not to be saved. A map without landmarks is not
  /// saved, and the next save is due soon. The motion since the map, which OdometryKeeper must have received before, is
  /// written with it: see drivers/storage/kept_odometry.hpp.
  bool save(const MapSnapshot& map);

  const MapKeeperStatus& status() const { return status_; }
  /// The keeper of the odometry beside the map. Null: there is none.
  OdometryKeeper* odometry() { return odometry_ ? &*odometry_ : nullptr; }

 private:
  Clock::duration age_of_saved() const;
  Clock::duration due_soon() const;
  bool save_place(const MapSnapshot& map);
  std::string write(const MapSnapshot& map, const std::string& file);

  MapSettings settings_;
  MapKeeperStatus status_;
  bool saves_;
  bool place_trouble_ = false;
  std::optional<OdometryKeeper> odometry_;
  std::optional<Clock::time_point>
      asked_;                     // start of the save interval: first call of is_due(), or last one that was due
  Clock::duration head_start_{};  // part of the interval that counts as passed at asked_
  std::vector<std::byte> bytes_;
};

}  // namespace azimuth
