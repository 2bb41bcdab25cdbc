#pragma once
// What is kept beside a map, several times a second, so that the next start knows where the robot is: FILE.odometry.
//
// It has room for two records, each of which names the map that it belongs to. A new one takes the place of the one
// that is not needed any more, and the record of a new map is there before that map takes its name. So whatever a
// process that is killed leaves, the map that the next start reads has its record:
//
//   killed when                                          map that is read     records of
//   the way was written as always                        A                    A and A
//   ... half                                             A                    A
//   the record of the new map B was written              A                    A and B
//   ... and B beside A, half or whole                    A                    A and B
//   ... and A had become FILE.previous                   A, as the previous   A and B
//   ... and B had taken its name                         B                    A and B
//   the way since B was written as always                B                    B and B
//   B could not be written                               A                    A and B
//   the next process has begun, without odometry yet     as it was left       as it was left
//
// A record that has become old is not wrong: the odometer counts on, and what it counted is what the robot drove since.
// Only how it got there is less certain, so one that is many seconds old may end in a search. Both are thrown away when
// nobody knows any more how the robot went, and when the odometer begins anew. (A process that makes a controller begin
// anew and is killed before its first reading, a tenth of a second later, leaves them: the next one compares the
// counters and finds that they do not go on, unless they happen to be as near as the robot can have driven.)
//
// All this outlives the process however that ends, not the machine: nothing is forced to the disk, and a record is of
// no use after another boot, in whatever order the disk took it. Maps are forced to it, before they take their name.
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
#include "slam/sample/odometry_since.hpp"

namespace azimuth {

/// The clock of stamps. Those of another boot, or from before the machine slept, cannot be compared with ours.
struct StampClock {
  std::string boot;  ///< the kernel's name for it
  Duration asleep{};
  Duration epoch_minus_monotonic{};
  friend bool operator==(const StampClock&, const StampClock&) = default;
};

struct KeptOdometry {
  StampClock clock;                ///< of all stamps but `since.map`
  std::uint32_t map_checksum = 0;  ///< of the map file that `since` begins at
  OdometrySince since;             ///< for the estimator
  OdometerMemory odometer;         ///< for the odometer: of the origin of `since.reading`
};

inline constexpr std::string_view kKeptOdometryMagic = "azimuth odometry\n";
inline constexpr std::uint32_t kKeptOdometryVersion = 1;

/// Replaces `out`. Strings that are too long for the file are cut.
void encode(const KeptOdometry& kept, std::vector<std::byte>& out);

/// Nothing for what encode() would not have written: damaged, of another version, or with values that cannot be true.
std::optional<KeptOdometry> decode_kept_odometry(Bytes bytes);

/// Beside that map.
std::filesystem::path kept_odometry_file(const std::filesystem::path& map);

/// The records of a file, each of encode()'s size, one after the other.
using KeptRecords = std::array<std::optional<KeptOdometry>, 2>;

/// Nothing in its place: there is none, or none that can be read.
KeptRecords read_kept_odometry(const std::filesystem::path& file);

/// The same odometry on the clock of another process of the same boot; nothing: its stamps mean nothing there.
std::optional<KeptOdometry> on_clock(KeptOdometry kept, const StampClock& clock);

}  // namespace azimuth
