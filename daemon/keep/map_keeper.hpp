#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/keep/map_settings.hpp"
#include "daemon/keep/odometry_keeper.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

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
