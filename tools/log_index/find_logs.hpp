#pragma once
// Finds the field logs in a folder without opening them.
//
// Thread contract: reentrant.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// A session folder with segments, or a log in a single file.
struct FoundLog {
  std::string path;               ///< relative to the searched folder
  std::uint64_t bytes = 0;        ///< size without separately stored images
  std::uint64_t image_bytes = 0;  ///< size of separately stored images
  std::uint64_t files = 0;        ///< number of segments; 1 for a single file
  std::int64_t changed_ns = 0;    ///< latest modification time of its files, on the file system's clock
};

struct FoundLogs {
  std::vector<FoundLog> logs;  ///< sorted by path
  FileErrors unreadable;       ///< folders that could not be searched
};

/// All logs in the folder and its subfolders. Symbolic links to folders are not followed.
FoundLogs find_logs(const std::filesystem::path& folder);

}  // namespace azimuth
