#include "tools/log_index/catalogue.hpp"

#include <fmt/format.h>
#include <optional>
#include <sqlite3.h>
#include <string_view>
#include <utility>

namespace azimuth {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApplication = 0x415A4C47;  // "AZLG", SQLite's application id in the file header
constexpr std::int64_t kSchema = 1;
constexpr int kPatience_ms = 10'000;  // time to wait for another process that writes
constexpr std::string_view kBusy = "is being written by another process";

constexpr const char* kTables = R"(
CREATE TABLE catalogue (folder TEXT NOT NULL);
CREATE TABLE logs (
  path TEXT PRIMARY KEY,
  start_utc TEXT, duration_s REAL,
  robot TEXT, version TEXT, estimator TEXT,
  starting REAL, tracking REAL, degraded REAL, lost REAL, silent_s REAL,
  poses INTEGER NOT NULL, distance_m REAL,
  min_x_m REAL, min_y_m REAL, max_x_m REAL, max_y_m REAL,
  bytes INTEGER NOT NULL, image_bytes INTEGER NOT NULL, files INTEGER NOT NULL,
  cut INTEGER NOT NULL, damaged_bytes INTEGER NOT NULL, missing_segments INTEGER NOT NULL,
  lost_events INTEGER NOT NULL, malformed_messages INTEGER NOT NULL,
  trouble TEXT, changed_ns INTEGER NOT NULL);
CREATE INDEX logs_by_start ON logs (start_utc);
)";

/// The folder of the logs relative to the catalogue file.
std::string folder_from(const fs::path& file, const fs::path& folder) {
  std::error_code ignored;
  return fs::weakly_canonical(folder, ignored)
      .lexically_relative(fs::weakly_canonical(fs::absolute(file), ignored).parent_path())
      .string();
}

}  // namespace

/// An SQL statement with its values in order.
class Catalogue::Statement {
 public:
  Statement(sqlite3* database, const char* sql) { sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }

  /// Empty text becomes NULL.
  Statement& operator<<(const std::string& value) {
    const int size = static_cast<int>(value.size());
    if (value.empty())
      sqlite3_bind_null(statement_, ++bound_);
    else
      sqlite3_bind_text(statement_, ++bound_, value.data(), size, SQLITE_TRANSIENT);
    return *this;
  }
  Statement& operator<<(std::int64_t value) { return sqlite3_bind_int64(statement_, ++bound_, value), *this; }
  Statement& operator<<(std::uint64_t value) { return *this << static_cast<std::int64_t>(value); }
  Statement& operator<<(std::optional<double> value) {
    if (value)
      sqlite3_bind_double(statement_, ++bound_, *value);
    else
      sqlite3_bind_null(statement_, ++bound_);
    return *this;
  }

  int step() { return statement_ == nullptr ? SQLITE_ERROR : sqlite3_step(statement_); }
  std::int64_t number(int column) { return sqlite3_column_int64(statement_, column); }
  std::uint64_t count(int column) { return static_cast<std::uint64_t>(number(column)); }
  double real(int column) { return sqlite3_column_double(statement_, column); }
  std::string text(int column) {
    const unsigned char* begin = sqlite3_column_text(statement_, column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return begin == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(begin), size);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

bool is_busy(const FileErrors& errors) { return errors.front().message == kBusy; }

void Catalogue::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

FileError Catalogue::trouble() const {
  const int code = sqlite3_errcode(database_.get());
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) return refusal("is no catalogue of logs that can be read");
  if (code == SQLITE_BUSY) return refusal(std::string(kBusy));
  return refusal(fmt::format("cannot be used: {}", sqlite3_errmsg(database_.get())));
}

FileResult<void> Catalogue::run(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return failure(trouble());
  return {};
}

FileResult<std::int64_t> Catalogue::number(const char* sql) {
  Statement statement(database_.get(), sql);
  if (statement.step() != SQLITE_ROW) return failure(trouble());
  return statement.number(0);
}

FileResult<Catalogue> Catalogue::open(const fs::path& file, const fs::path& folder) {
  sqlite3* database = nullptr;
  const int opened = sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  Catalogue catalogue(file, database);
  if (opened != SQLITE_OK) return failure(catalogue.trouble());
  sqlite3_busy_timeout(database, kPatience_ms);
  const FileResult<void> prepared = catalogue.prepare(folder_from(file, folder));
  if (!prepared) return failure(prepared.error());
  return catalogue;
}

FileResult<void> Catalogue::prepare(const std::string& folder) {
  const auto pages = number("PRAGMA page_count");
  if (!pages) return failure(pages.error());
  return *pages == 0 ? make(folder) : check(folder);
}

FileResult<void> Catalogue::make(const std::string& folder) {
  if (const auto begun = run("BEGIN IMMEDIATE"); !begun) return begun;
  const std::string marks =
      fmt::format("{} PRAGMA application_id = {}; PRAGMA user_version = {};", kTables, kApplication, kSchema);
  if (const auto made = run(marks.c_str()); !made) return made;
  Statement insert(database_.get(), "INSERT INTO catalogue VALUES (?)");
  if ((insert << folder).step() != SQLITE_DONE) return failure(trouble());
  return run("COMMIT");
}

FileResult<void> Catalogue::check(const std::string& folder) {
  const auto application = number("PRAGMA application_id"), schema = number("PRAGMA user_version");
  if (!application) return failure(application.error());
  if (!schema) return failure(schema.error());
  if (*application != kApplication) return failure(refusal("is another program's, not a catalogue of logs"));
  if (*schema != kSchema)
    return failure(refusal(fmt::format("is a catalogue of version {}; this version writes {}", *schema, kSchema)));
  Statement known(database_.get(), "SELECT folder FROM catalogue");
  if (known.step() != SQLITE_ROW) return failure(trouble());
  if (known.text(0) != folder)
    return failure(refusal("is the catalogue of another folder, " + known.text(0) + " from where it lies"));
  return {};
}

FileResult<std::map<std::string, LogState>> Catalogue::states() {
  std::map<std::string, LogState> states;
  Statement rows(database_.get(), "SELECT path, bytes, image_bytes, files, changed_ns FROM logs");
  int got = SQLITE_ROW;
  while ((got = rows.step()) == SQLITE_ROW)
    states[rows.text(0)] = {rows.count(1), rows.count(2), rows.count(3), rows.number(4)};
  if (got != SQLITE_DONE) return failure(trouble());
  return states;
}

FileResult<void> Catalogue::insert(const CatalogueRow& row) {
  const LogSummary& summary = row.summary;
  const bool has_poses = summary.poses > 0;
  const auto share = [&](std::size_t i) { return row.health ? std::optional((*row.health)[i]) : std::nullopt; };
  const auto side = [&](double PoseBox::*edge) {
    return summary.box ? std::optional((*summary.box).*edge) : std::nullopt;
  };
  const auto known = [&](double value) { return has_poses ? std::optional(value) : std::nullopt; };
  Statement insert(database_.get(),
                   "INSERT OR REPLACE INTO logs VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  insert << row.found.path << row.start_utc.value_or("") << row.duration_s << row.robot << row.version << row.estimator;
  insert << share(0) << share(1) << share(2) << share(3) << known(summary.silent_s);
  insert << summary.poses << known(summary.distance_m);
  insert << side(&PoseBox::min_x_m) << side(&PoseBox::min_y_m) << side(&PoseBox::max_x_m) << side(&PoseBox::max_y_m);
  insert << row.found.bytes << row.found.image_bytes << row.found.files;
  insert << static_cast<std::int64_t>(row.is_cut()) << summary.damaged_bytes << summary.missing_segments;
  insert << summary.lost_events << summary.malformed << row.trouble << row.found.changed_ns;
  if (insert.step() != SQLITE_DONE) return failure(trouble());
  return {};
}

FileResult<void> Catalogue::update(std::span<const CatalogueRow> rows, std::span<const std::string> vanished) {
  if (const auto begun = run("BEGIN IMMEDIATE"); !begun) return begun;
  const auto undo = [this](FileErrors errors) {
    static_cast<void>(run("ROLLBACK"));
    return failure(std::move(errors));
  };
  for (const CatalogueRow& row : rows)
    if (const auto inserted = insert(row); !inserted) return undo(inserted.error());
  for (const std::string& path : vanished) {
    Statement remove(database_.get(), "DELETE FROM logs WHERE path = ?");
    if ((remove << path).step() != SQLITE_DONE) return undo({trouble()});
  }
  if (const auto done = run("COMMIT"); !done) return undo(done.error());
  return {};
}

FileResult<CatalogueTotals> Catalogue::totals() {
  Statement row(
      database_.get(),
      "SELECT count(*), count(trouble), total(bytes + image_bytes), total(duration_s), total(distance_m) FROM logs");
  if (row.step() != SQLITE_ROW) return failure(trouble());
  return CatalogueTotals{row.count(0), row.count(1), row.count(2), row.real(3), row.real(4)};
}

}  // namespace azimuth
