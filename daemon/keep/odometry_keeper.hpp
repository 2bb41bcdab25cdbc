#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "drivers/io/kept_odometry.hpp"
#include "drivers/io/unique_fd.hpp"

namespace azimuth {

/// The clock of this process's stamps.
StampClock stamp_clock(Duration epoch_minus_monotonic);

/// Keeps what the next start needs to know where the robot is (drivers/io/kept_odometry.hpp), beside the map that it
/// belongs to. Two know one half each: the odometer how it counts, the estimator how the robot went since the map was
/// saved. What cannot be written is tried again with the next news, and missed by nobody but a start that then
/// searches.
///
/// What a start before left is removed at once: whatever it says is no longer true when this process drives.
///
/// Thread contract: thread-bound; not for real-time threads.
class OdometryKeeper {
 public:
  OdometryKeeper(const std::filesystem::path& map, StampClock clock);

  /// The map on the disk.
  void map_is(Stamp stamp, std::uint32_t checksum);
  void odometer_is(const OdometerMemory& memory);
  /// Nothing: nobody knows how the robot went.
  void robot_went(const std::optional<OdometrySince>& since);
  bool knows_way() const { return knows_way_; }

  /// Puts the newest of both on the disk, if they belong together, and to the map.
  void write();
  /// Nobody can go on with this.
  void forget();

 private:
  std::filesystem::path file_;
  UniqueFd fd_;
  std::optional<Stamp> map_;
  bool knows_way_ = false, knows_odometer_ = false, empty_ = true;
  KeptOdometry kept_;
  std::vector<std::byte> bytes_;
};

}  // namespace azimuth
