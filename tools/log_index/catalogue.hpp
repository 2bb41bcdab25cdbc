#pragma once
// The catalogue of field logs, an SQLite file. docs/fleet.md documents its tables.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "tools/log_index/catalogue_row.hpp"

struct sqlite3;

namespace azimuth {

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
