#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/file_result.hpp"
#include "drivers/storage/log_summary.hpp"

namespace azimuth {

/// A session folder with segments, or a log in a single file.
struct FoundLog {
  std::string path;               ///< relative to the searched folder
  std::uint64_t bytes = 0;        ///< size without separately stored images
  std::uint64_t image_bytes = 0;  ///< size of separately stored images
  std::uint64_t files = 0;        ///< number of segments; 1 for a single file
  std::int64_t changed_ns = 0;    ///< latest modification time of its files, on the file system's clock
};

/// The catalogue entry of a log. Unknown values are empty.
struct CatalogueRow {
  FoundLog found;
  std::optional<std::string> start_utc;  ///< for example 2026-11-21T13:05:00Z
  std::optional<double> duration_s;
  std::string robot;                            ///< prefix of the LCM channels, or the odometer; may be empty
  std::string version;                          ///< version of the daemon; empty if unknown
  std::string estimator;                        ///< empty if the log has no readable rig and settings
  std::optional<std::array<double, 4>> health;  ///< shares of the time covered by poses, in the order of Health
  LogSummary summary;                           ///< all zero for an unreadable log
  std::string trouble;                          ///< short description of damage; empty if there is none

  /// True if the log is incomplete: bytes, segments or events are missing.
  bool is_cut() const { return summary.damaged_bytes > 0 || summary.missing_segments > 0 || summary.lost_events > 0; }
};

/// The entry of a readable log.
CatalogueRow row_of(const FoundLog& found, const LogSummary& summary);
/// The entry of an unreadable log.
CatalogueRow row_of(const FoundLog& found, const FileErrors& errors);

}  // namespace azimuth
