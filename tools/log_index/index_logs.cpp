#include "tools/log_index/index_logs.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace azimuth {
namespace {

namespace fs = std::filesystem;

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
