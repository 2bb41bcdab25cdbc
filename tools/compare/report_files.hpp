#pragma once
// Reads reports of `azimuth replay`: from texts, and from files and folders.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "tools/compare/figure.hpp"

namespace azimuth {

/// The values of one report that are compared.
struct RunReport {
  std::string file;  ///< file name as given to the reader
  std::string name;  ///< pairs the report with others: the name from `replay --name`, otherwise that of the run
  std::vector<std::string> tags;
  std::vector<std::string> overrides;  ///< settings changed with `--set`
  std::string estimator, made_by;      ///< may be empty
  std::string digest;                  ///< digest of the estimates; empty if unknown
  std::uint64_t seed = 0;
  bool is_older = false;                  ///< the report's format has neither name nor tags
  std::string incomplete;                 ///< unreadable part of the recording; empty if none
  std::string failure;                    ///< reason why the replay failed; empty if it succeeded
  std::array<double, kFigures> values{};  ///< in the order of figures(), in the report's units; NaN: not measured
};

/// Reads the text of a report, or of the object with `name` and `failure` that replaces the report of a failed replay.
/// Errors name `file`. For any text, the function throws at most std::bad_alloc.
FileResult<RunReport> read_report(std::string_view text, const std::string& file);

/// The reports in the order of the arguments, within a folder sorted by name.
struct Reports {
  std::vector<RunReport> all;
  FileErrors unreadable;  ///< one error for each unusable file
};

/// `places`: report files, and folders that contain reports as *.json at any depth.
Reports read_reports(std::span<const std::filesystem::path> places, const Progress& progress = {});

}  // namespace azimuth
