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

}  // namespace azimuth
