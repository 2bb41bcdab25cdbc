#include "tools/log_index/index_logs.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

#include "drivers/storage/session.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

struct FoundLogs {
  std::vector<FoundLog> logs;  ///< sorted by path
  FileErrors unreadable;       ///< folders that could not be searched
};

bool is_log_name(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".lcmlog" || extension == ".lcm" || extension == ".log";
}

std::int64_t nanoseconds_of(fs::file_time_type time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// Adds a file to a log. A file that a recorder deletes in the meantime is ignored.
void add_file(FoundLog& log, std::uint64_t& bytes, const fs::path& file) {
  std::error_code no_size, no_time;
  const std::uintmax_t size = fs::file_size(file, no_size);
  const fs::file_time_type time = fs::last_write_time(file, no_time);
  if (no_size || no_time) return;
  bytes += size;
  log.changed_ns = log.files == 0 ? nanoseconds_of(time) : std::max(log.changed_ns, nanoseconds_of(time));
}

class Search {
 public:
  explicit Search(fs::path top) : top_(std::move(top)) {}

  FoundLogs run() && {
    look_into(top_);
    std::ranges::sort(found_.logs, {}, &FoundLog::path);
    return std::move(found_);
  }

 private:
  void look_into(const fs::path& folder) {
    const std::vector<SegmentFile> segments = session_segments(folder);
    if (!segments.empty()) add_session(folder, segments);
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      std::error_code ignored;
      const fs::path name = entry->path().filename();
      const bool link = entry->is_symlink(ignored);
      if (entry->is_directory(ignored)) {
        if (!link && !(name == kFramesPart && !segments.empty())) look_into(entry->path());
      } else if (is_log_name(name) && !segment_number(name.string()) && entry->is_regular_file(ignored)) {
        add_log(entry->path());
      }
    }
    if (error) found_.unreadable.push_back(system_error(folder.string(), "cannot be searched", error.value()));
  }
  void add_session(const fs::path& folder, const std::vector<SegmentFile>& segments) {
    FoundLog log;
    log.path = relative(folder);
    for (const SegmentFile& segment : segments) {
      add_file(log, log.bytes, segment.file);
      ++log.files;
    }
    for (const SegmentFile& segment : session_segments(folder / kFramesPart))
      add_file(log, log.image_bytes, segment.file);
    found_.logs.push_back(std::move(log));
  }
  void add_log(const fs::path& file) {
    FoundLog log;
    log.path = relative(file);
    add_file(log, log.bytes, file);
    log.files = 1;
    found_.logs.push_back(std::move(log));
  }
  std::string relative(const fs::path& path) const { return path.lexically_relative(top_).string(); }

  fs::path top_;
  FoundLogs found_;
};

/// All logs in the folder and its subfolders, found without opening them. Symbolic links to folders are not followed.
FoundLogs find_logs(const fs::path& folder) { return Search(folder).run(); }

/// Reads a log. A failure of any kind affects only the row of this log.
CatalogueRow read_row(const fs::path& folder, const FoundLog& log) {
  try {
    const FileResult<LogSummary> summary = read_log_summary(folder / log.path);
    return summary ? row_of(log, *summary) : row_of(log, summary.error());
  } catch (const std::exception& error) {  // mainly std::bad_alloc
    return row_of(log, FileErrors{{log.path, 0, std::string("cannot be read: ") + error.what()}});
  }
}

bool lies_in(const std::string& path, const fs::path& folder, const FileError& unreadable) {
  const std::string inside = (folder / path).string();
  return inside == unreadable.file || inside.starts_with(unreadable.file + '/');
}

/// Logs that are in the catalogue but no longer exist.
std::vector<std::string> vanished_of(const std::map<std::string, LogState>& known, const FoundLogs& found,
                                     const fs::path& folder) {
  std::vector<std::string> vanished;
  for (const auto& entry : known) {
    const std::string& path = entry.first;
    const bool there = std::ranges::binary_search(found.logs, path, {}, &FoundLog::path);
    const bool hidden = std::ranges::any_of(
        found.unreadable, [&](const FileError& unreadable) { return lies_in(path, folder, unreadable); });
    if (!there && !hidden) vanished.push_back(path);
  }
  return vanished;
}

}  // namespace

FileResult<IndexResult> index_logs(const fs::path& folder, const fs::path& file, const Progress& progress) {
  FileResult<Catalogue> catalogue = Catalogue::open(file, folder);
  if (!catalogue) return failure(catalogue.error());
  const auto known = catalogue->states();
  if (!known) return failure(known.error());

  FoundLogs found = find_logs(folder);
  const std::vector<std::string> vanished = vanished_of(*known, found, folder);
  IndexResult result;
  result.vanished = vanished.size();
  result.troubles = std::move(found.unreadable);
  std::vector<CatalogueRow> rows;
  std::size_t looked_at = 0;
  for (const FoundLog& log : found.logs) {
    if (progress) progress(looked_at++, found.logs.size());
    const auto before = known->find(log.path);
    if (before != known->end() && before->second == state_of(log)) {
      ++result.unchanged;
      continue;
    }
    rows.push_back(read_row(folder, log));
    if (!rows.back().trouble.empty()) result.troubles.push_back({(folder / log.path).string(), 0, rows.back().trouble});
  }
  result.read = rows.size();
  if (const auto updated = catalogue->update(rows, vanished); !updated) return failure(updated.error());
  const FileResult<CatalogueTotals> totals = catalogue->totals();
  if (!totals) return failure(totals.error());
  result.totals = *totals;
  return result;
}

std::string summary_of(const IndexResult& result) {
  const CatalogueTotals& totals = result.totals;
  return fmt::format("{} logs ({} read, {} unchanged, {} vanished, {} with trouble): {:.1f} h, {:.1f} km, {:.0f} MB",
                     totals.logs, result.read, result.unchanged, result.vanished, totals.in_trouble,
                     totals.duration_s / 3600.0, 1e-3 * totals.distance_m, 1e-6 * static_cast<double>(totals.bytes));
}

}  // namespace azimuth
