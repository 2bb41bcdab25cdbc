#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/storage/log_summary.hpp"
#include "tools/log_index/find_logs.hpp"

namespace azimuth {

/// What the catalogue says of a log; what nobody knows is left out.
struct CatalogueRow {
  FoundLog found;
  std::optional<std::string> start_utc;  ///< such as 2026-11-21T13:05:00Z
  std::optional<double> duration_s;
  std::string robot;                            ///< its channels' prefix or its odometer; empty: it has no name
  std::string version;                          ///< of the daemon; empty: it does not say
  std::string estimator;                        ///< empty: without a rig and settings that can be read
  std::optional<std::array<double, 4>> health;  ///< shares of the time that poses tell of, see Health
  LogSummary summary;                           ///< all zero where there was nothing to read
  std::string trouble;                          ///< what is wrong with it, in a few words; empty: nothing

  /// Something of it is missing: bytes, segments, or events that could not be written.
  bool is_cut() const { return summary.damaged_bytes > 0 || summary.missing_segments > 0 || summary.lost_events > 0; }
};

/// Of a log that could be read.
CatalogueRow row_of(const FoundLog& found, const LogSummary& summary);
/// Of one that could not.
CatalogueRow row_of(const FoundLog& found, const FileErrors& errors);

}  // namespace azimuth
