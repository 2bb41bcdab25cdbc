#pragma once
// The catalogue of field logs, an SQLite file. docs/fleet.md documents its tables.
struct sqlite3;

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
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

/// Properties by which a change of a log is detected.
struct LogState {
  std::uint64_t bytes = 0, image_bytes = 0, files = 0;
  std::int64_t changed_ns = 0;
  friend bool operator==(const LogState&, const LogState&) = default;
};
inline LogState state_of(const FoundLog& log) { return {log.bytes, log.image_bytes, log.files, log.changed_ns}; }

/// Totals over all logs in the catalogue.
struct CatalogueTotals {
  std::uint64_t logs = 0, in_trouble = 0, bytes = 0;
  double duration_s = 0.0, distance_m = 0.0;
};

/// True if an operation failed only because another process was writing the catalogue. It may succeed later.
bool is_busy(const FileErrors& errors);

/// An open catalogue. Thread contract: thread-bound.
class Catalogue {
 public:
  /// Opens the file or creates it. Fails if the file belongs to another program, to a newer version, or to another
  /// folder than `folder`. The catalogue stores the folder relative to the file, so that both can be moved together.
  static FileResult<Catalogue> open(const std::filesystem::path& file, const std::filesystem::path& folder);

  /// The states of all logs by path.
  FileResult<std::map<std::string, LogState>> states();

  /// Replaces the entries of the logs in `rows` and deletes those of `vanished`. On failure the catalogue is unchanged.
  FileResult<void> update(std::span<const CatalogueRow> rows, std::span<const std::string> vanished);

  FileResult<CatalogueTotals> totals();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  class Statement;

  Catalogue(std::filesystem::path file, sqlite3* database) : file_(std::move(file)), database_(database) {}

  FileResult<void> prepare(const std::string& folder);
  FileResult<void> make(const std::string& folder);
  FileResult<void> check(const std::string& folder);
  FileResult<void> run(const char* sql);
  FileResult<void> insert(const CatalogueRow& row);
  FileResult<std::int64_t> number(const char* sql);
  FileError refusal(std::string why) const { return {file_.string(), 0, std::move(why)}; }
  FileError trouble() const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace azimuth
