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

/// How the saved map is.
struct MapKeeperStatus {
  std::string text;             ///< what became of the last one, for a person
  bool trouble = false;         ///< it could not be loaded or saved
  bool unfit = false;           ///< the one on the disk cannot be started from: it is set aside before one is saved
  std::int64_t written_us = 0;  ///< when the one on the disk was, since the Unix epoch; 0: there is none
  std::uint64_t saved = 0;      ///< since the start
  std::uint64_t failed = 0;     ///< likewise
};

/// Saves maps, and knows when the next one is due. What is implausible is not written over a good map; trouble with the
/// disk is logged once, and the next interval tries again.
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). save() allocates.
class MapKeeper {
 public:
  using Clock = std::chrono::steady_clock;

  /// `start` says what became of the map that was to be loaded. Unless it `saves`, the file stays as it is, and where
  /// the robot is on it goes to its located_map(). `odometry` is kept beside it; none, as for what is played, which is
  /// not where it was when it is played again: then nothing goes there either.
  MapKeeper(MapSettings settings, MapKeeperStatus start, bool saves, std::optional<OdometryKeeper> odometry = {});

  /// An interval has passed since the last save, which may be that of a start before: one that is killed again and
  /// again would never save, and the way since its map would become too long to be believed. Where there is no map, an
  /// interval since the first call; a short one when how the robot went since the last map is not known, and when there
  /// was nothing to save.
  bool is_due(Clock::time_point now);

  /// Puts it on the disk; false: it is not there, or is not to be. Without landmarks it is nothing to keep, and the
  /// next one is due soon. The way since then, which the odometry's keeper is to have been told, goes there with it:
  /// see drivers/storage/kept_odometry.hpp.
  bool save(const MapSnapshot& map);

  const MapKeeperStatus& status() const { return status_; }
  /// Null: there is none.
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
  std::optional<Clock::time_point> asked_;  // the last time, or first whether it is due
  Clock::duration head_start_{};            // of the interval, over by then
  std::vector<std::byte> bytes_;
};

}  // namespace azimuth
