#pragma once
// The odometry that is kept beside a map, several times a second, so that the next start knows the pose of the robot.
// Its file is FILE.odometry.
//
// The file has room for two records, each of which names the map that it belongs to. A new record replaces the one that
// is no longer needed. The record of a new map is written before that map takes its final name. So whenever the process
// is killed, the map that the next start reads has its record:
//
//   killed when                                          map that is read     records of
//   the motion since A had been written as usual         A                    A and A
//   ... had been written in part                         A                    A
//   the record of the new map B had been written         A                    A and B
//   ... and B beside A, in part or completely            A                    A and B
//   ... and A had been renamed FILE.previous             A, as the previous   A and B
//   ... and B had taken its name                         B                    A and B
//   the motion since B had been written as usual         B                    B and B
//   B could not be written                               A                    A and B
//   the next process runs, without odometry yet          unchanged            unchanged
//
// An old record is still valid: the odometer continues to count, and its counts are the motion of the robot since. Only
// the uncertainty grows, so a record that is many seconds old may end in a relocalisation. Both records are discarded
// when the motion of the robot is no longer known, and when the odometer restarts its counting. (A process may be
// killed after it made a controller restart and before its first reading, within a tenth of a second. The records then
// stay. The next process compares the counters and finds that they do not continue, unless they are by chance as close
// as the robot can have driven.)
//
// The records survive any end of the process, but not of the machine: nothing is forced to the disk, and a record is
// useless after another boot. Maps are forced to the disk before they take their names.
//
// Thread contract: reentrant; one writer of a file at a time.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/file_result.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The clock of stamps. Stamps of another boot, or from before the machine slept, cannot be compared with stamps of
/// this one.
struct StampClock {
  std::string boot;  ///< the kernel's identifier of the boot
  Duration asleep{};
  Duration epoch_minus_monotonic{};
  friend bool operator==(const StampClock&, const StampClock&) = default;
};

struct KeptOdometry {
  StampClock clock;                ///< clock of all stamps except `since.map`
  std::uint32_t map_checksum = 0;  ///< checksum of the map file at which `since` begins
  OdometrySince since;             ///< for the estimator
  OdometerMemory odometer;         ///< for the odometer; of the same origin as `since.reading`
};

inline constexpr std::string_view kKeptOdometryMagic = "azimuth odometry\n";
inline constexpr std::uint32_t kKeptOdometryVersion = 1;

/// Replaces `out`. Strings that are too long for the file are truncated.
void encode(const KeptOdometry& kept, std::vector<std::byte>& out);

/// None for bytes that encode() would not have written: damaged, of another version, or with implausible values.
std::optional<KeptOdometry> decode_kept_odometry(Bytes bytes);

/// The file of the odometry beside the map file `map`.
std::filesystem::path kept_odometry_file(const std::filesystem::path& map);

/// The records of a file, each with the size of encode()'s output, one after the other.
using KeptRecords = std::array<std::optional<KeptOdometry>, 2>;

/// None in place of a record that is missing or cannot be read.
KeptRecords read_kept_odometry(const std::filesystem::path& file);

/// The same odometry on the clock of another process of the same boot. None: its stamps cannot be converted.
std::optional<KeptOdometry> on_clock(KeptOdometry kept, const StampClock& clock);

}  // namespace azimuth
