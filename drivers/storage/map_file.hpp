#pragma once
// Maps on disk. The newest map is never at risk: it is written beside the old one and renamed when it is completely on
// the disk. The map before it is kept as FILE.previous, in case the newest cannot be read.
//
// Thread contract: reentrant; one writer of a file at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/map_codec.hpp"

namespace azimuth {

/// The file of the previous map.
std::filesystem::path previous_map(const std::filesystem::path& file);

/// The file of the map with the current pose of the robot, used when the map itself is not saved.
std::filesystem::path located_map(const std::filesystem::path& file);

/// True: the file or its predecessor exists.
bool map_exists(const std::filesystem::path& file);

/// A map that was read.
struct LoadedMap {
  MapSnapshot map;
  std::vector<std::byte> bytes;  ///< contents of the file
  std::filesystem::path file;    ///< the file that was read
  FileErrors troubles;           ///< errors in the newer file; empty: none
};

/// The newest readable map among the file and its predecessor. When neither is readable, all errors in both.
FileResult<LoadedMap> read_map(const std::filesystem::path& file);

/// Reads only this file.
FileResult<LoadedMap> read_map_only(const std::filesystem::path& file);

/// Replaces the file by `bytes`, an encoded map, so that there is a good map on the disk at every moment. An existing
/// file that is not a complete map becomes FILE.refused instead of the previous map. Creates the folder if necessary.
[[nodiscard]] FileResult<void> write_map(Bytes bytes, const std::filesystem::path& file);

/// Renames a map that cannot be used at present, although it may be sound, to FILE.aside.1 or the first free number.
/// When all numbers are taken, the last one is reused. A missing file is not an error.
[[nodiscard]] FileResult<void> set_map_aside(const std::filesystem::path& file);

}  // namespace azimuth
