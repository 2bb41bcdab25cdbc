#pragma once
// Which field logs lie in a folder, without one of them being opened.
//
// Thread contract: reentrant.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// A session folder with its segments, or a log that is one file.
struct FoundLog {
  std::string path;               ///< relative to the folder that was searched
  std::uint64_t bytes = 0;        ///< without images in a folder of their own
  std::uint64_t image_bytes = 0;  ///< of these
  std::uint64_t files = 0;        ///< segments; 1 of a log that is one file
  std::int64_t changed_ns = 0;    ///< when the youngest of its files was last written, on the file system's clock
};

struct FoundLogs {
  std::vector<FoundLog> logs;  ///< by their paths
  FileErrors unreadable;       ///< folders that cannot be looked into
};

/// Every log in the folder and below it. Symbolic links to folders are not followed.
FoundLogs find_logs(const std::filesystem::path& folder);

}  // namespace azimuth
