#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "tools/log_index/catalogue.hpp"

namespace azimuth {

/// What became of the logs.
struct IndexResult {
  CatalogueTotals totals;
  std::uint64_t read = 0, unchanged = 0, vanished = 0;
  FileErrors troubles;  ///< of the logs read now, and of folders that cannot be searched
};

/// Brings the catalogue in `file` up to date with the field logs in a folder and below it: those that have changed
/// since are read, those that are no longer there are forgotten. Logs in a folder that cannot be searched now stay.
/// Reentrant.
FileResult<IndexResult> index_logs(const std::filesystem::path& folder, const std::filesystem::path& file,
                                   const Progress& progress = {});

/// Like "12 logs (3 read, 9 unchanged, 1 vanished, 2 with trouble): 5.3 h, 12.4 km, 3200 MB".
std::string summary_of(const IndexResult& result);

}  // namespace azimuth
