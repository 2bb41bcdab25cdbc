#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "tools/log_index/catalogue.hpp"

namespace azimuth {

/// Result of updating the catalogue.
struct IndexResult {
  CatalogueTotals totals;
  std::uint64_t read = 0, unchanged = 0, vanished = 0;
  FileErrors troubles;  ///< errors of the logs read now, and folders that could not be searched
};

/// Updates the catalogue in `file` with the field logs in a folder and its subfolders. Changed logs are read; entries
/// of deleted logs are removed. Entries of logs in folders that cannot be searched stay. Reentrant.
FileResult<IndexResult> index_logs(const std::filesystem::path& folder, const std::filesystem::path& file,
                                   const Progress& progress = {});

/// Example: "12 logs (3 read, 9 unchanged, 1 vanished, 2 with trouble): 5.3 h, 12.4 km, 3200 MB".
std::string summary_of(const IndexResult& result);

}  // namespace azimuth
