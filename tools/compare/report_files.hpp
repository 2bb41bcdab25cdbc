#pragma once
// Reports by files and folders.

#include <filesystem>
#include <span>
#include <vector>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "tools/compare/run_report.hpp"

namespace azimuth {

/// All that was found, in the order in which it was given, and of a folder by name.
struct Reports {
  std::vector<RunReport> all;
  FileErrors unreadable;  ///< one for each file that cannot be used; the others are there all the same
};

/// `places`: reports, and folders that have them as *.json, at any depth.
Reports read_reports(std::span<const std::filesystem::path> places, const Progress& progress = {});

}  // namespace azimuth
