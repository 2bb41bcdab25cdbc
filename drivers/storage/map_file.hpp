#pragma once
// Maps on disk. The newest map is never put at risk: it is written beside the old one and takes its name when it is
// whole on the disk; the one before is kept as FILE.previous, for the day the newest cannot be read.
//
// Thread contract: reentrant; one writer of a file at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/map_codec.hpp"

namespace azimuth {

/// The file that the map before the newest one is kept in.
std::filesystem::path previous_map(const std::filesystem::path& file);

/// The file that holds the map and where the robot is on it, for a map that stays as it is itself.
std::filesystem::path located_map(const std::filesystem::path& file);

/// Whether there is something to read: the file or the one before.
bool map_exists(const std::filesystem::path& file);

/// A map as it was read.
struct LoadedMap {
  MapSnapshot map;
  std::vector<std::byte> bytes;  ///< of the file
  std::filesystem::path file;    ///< the one that was read
  FileErrors troubles;           ///< what was wrong with the newer one; empty: nothing
};

/// The newest map that can be read, of the file and the one before; all that is wrong with both when neither can.
FileResult<LoadedMap> read_map(const std::filesystem::path& file);

/// Only this very file.
FileResult<LoadedMap> read_map_only(const std::filesystem::path& file);

/// Replaces the file by `bytes`, which are an encoded map, without a moment in which no good map is on the disk. What
/// is there and is no whole map becomes FILE.refused instead of the previous one. The folder is made if need be.
[[nodiscard]] FileResult<void> write_map(Bytes bytes, const std::filesystem::path& file);

/// Renames a map that is of no use at present, though it may be whole: to FILE.aside.1, or the first number that is
/// free, the last being used again when all are. A file that is not there is no trouble.
[[nodiscard]] FileResult<void> set_map_aside(const std::filesystem::path& file);

}  // namespace azimuth
