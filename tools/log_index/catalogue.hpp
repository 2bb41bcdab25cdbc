#pragma once
// The catalogue's file. Its tables are documented in docs/fleet.md.

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

/// By what a log is known to have changed.
struct LogState {
  std::uint64_t bytes = 0, image_bytes = 0, files = 0;
  std::int64_t changed_ns = 0;
  friend bool operator==(const LogState&, const LogState&) = default;
};
inline LogState state_of(const FoundLog& log) { return {log.bytes, log.image_bytes, log.files, log.changed_ns}; }

/// Of everything in the catalogue.
struct CatalogueTotals {
  std::uint64_t logs = 0, in_trouble = 0, bytes = 0;
  double duration_s = 0.0, distance_m = 0.0;
};

/// Whether it failed for another process that writes the catalogue: nothing is wrong with it, and later it may be done.
bool is_busy(const FileErrors& errors);

/// Thread contract: thread-bound.
class Catalogue {
 public:
  /// Makes the file unless it is there. Refuses one that is another program's, a newer version's, or the catalogue of
  /// another folder than `folder`, which is kept relative to the file: both may move together.
  static FileResult<Catalogue> open(const std::filesystem::path& file, const std::filesystem::path& folder);

  /// By the logs' paths.
  FileResult<std::map<std::string, LogState>> states();

  /// Replaces what is known of these logs and forgets the others, or leaves everything as it was.
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
