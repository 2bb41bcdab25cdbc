#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/storage/kept_odometry.hpp"

namespace azimuth {

/// The clock of this process's stamps.
StampClock stamp_clock(Duration epoch_minus_monotonic);

/// Keeps what the next start needs to know where the robot is (drivers/storage/kept_odometry.hpp), beside the map that
/// it belongs to. Two know one half each: the odometer how it counts, the estimator how the robot went since the map
/// was saved. What cannot be written is tried again with the next news, and missed by nobody but a start that then
/// searches.
///
/// What a start before left stays until there is something newer: it is as true as it was while the odometer counts on.
///
/// Thread contract: thread-bound; not for real-time threads.
class OdometryKeeper {
 public:
  OdometryKeeper(const std::filesystem::path& map, StampClock clock);

  /// The map on the disk: what is kept for it is not overwritten before there is more.
  void map_is(Stamp stamp, std::uint32_t checksum);
  /// This map is going to take its place, or fails to, as on a full disk: what is known of the way since it is kept
  /// beside what is kept for the one before, which goes on.
  void map_comes(Stamp stamp, std::uint32_t checksum);
  /// Of another origin than what is kept: that is of no use any more.
  void odometer_is(const OdometerMemory& memory);
  /// Since both maps. Of neither: nobody knows how the robot went.
  void robot_went(const OdometryWays& ways);
  /// Since the map on the disk.
  bool knows_way() const { return map_ ? way_since(map_->stamp) != nullptr : ways_.since_map.has_value(); }

  /// Puts the newest of both on the disk, if they belong together, and to the map.
  void write();
  /// Nobody can go on with this.
  void forget();

 private:
  struct MapName {
    Stamp stamp;
    std::uint32_t checksum;
  };
  /// What a record says.
  struct Record {
    std::uint32_t map_checksum;
    std::uint32_t origin;  ///< of the odometry
  };
  const OdometrySince* way_since(Stamp map) const;
  std::size_t other() const { return 1 - newest_; }
  bool put(const MapName& map);

  std::filesystem::path file_;
  UniqueFd fd_;
  std::optional<MapName> map_;
  std::array<std::optional<Record>, 2> records_;  // in the file
  std::size_t newest_ = 0;                        // of them, for the map on the disk
  OdometryWays ways_;
  bool knows_odometer_ = false;
  KeptOdometry kept_;  // as it is written next
  std::vector<std::byte> bytes_;
};

}  // namespace azimuth
