#pragma once
// What is kept beside a map, several times a second, so that the next start knows where the robot is: FILE.odometry.
// A file of a fixed size that is written over in place: it outlives the process however that ends, which is all it is
// for. Not the machine: nothing is forced to the disk.
//
// Thread contract: reentrant; one writer of a file at a time.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/io/event_codec.hpp"
#include "drivers/io/file_result.hpp"
#include "drivers/io/odometer_memory.hpp"
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

/// Nothing: there is none, or none that can be read.
std::optional<KeptOdometry> read_kept_odometry(const std::filesystem::path& file);

/// The same odometry on the clock of another process of the same boot; nothing: its stamps mean nothing there.
std::optional<KeptOdometry> on_clock(KeptOdometry kept, const StampClock& clock);

}  // namespace azimuth
