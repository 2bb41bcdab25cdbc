#pragma once
// Reads reports from files and folders.

#include <filesystem>
#include <span>
#include <vector>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "tools/compare/run_report.hpp"

namespace azimuth {

/// The reports in the order of the arguments, within a folder sorted by name.
struct Reports {
  std::vector<RunReport> all;
  FileErrors unreadable;  ///< one error for each unusable file
};

/// `places`: report files, and folders that contain reports as *.json at any depth.
Reports read_reports(std::span<const std::filesystem::path> places, const Progress& progress = {});

}  // namespace azimuth
