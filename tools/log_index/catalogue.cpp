#include "tools/log_index/catalogue.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <numeric>
#include <sqlite3.h>
#include <string_view>
#include <utility>

#include "settings/configuration.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

constexpr double kMicroseconds = 1e-6;

/// Stamps between the years 2001 and 2100 are dates; stamps of simulated drives count from the start of the drive.
constexpr std::int64_t kFirstDate_us = 978'307'200'000'000, kLastDate_us = 4'102'444'800'000'000;

std::optional<std::string> utc_text(std::int64_t since_epoch_us) {
  if (since_epoch_us < kFirstDate_us || since_epoch_us > kLastDate_us) return std::nullopt;
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(since_epoch_us / 1'000'000)));
}

/// The robot's name: the channel prefix without trailing separators, for example ROBOT7 for "ROBOT7_". Without a prefix
/// it is the name of the odometer.
std::string robot_of(const LogSummary& summary) {
  std::string name = summary.prefix;
  while (!name.empty() && (name.back() == '_' || name.back() == '/' || name.back() == '.')) name.pop_back();
  return name.empty() ? summary.odometer : name;
}

/// The estimator; empty if rig or settings are unreadable.
std::string estimator_of(const LogSummary& summary) {
  if (summary.rig_toml.empty()) return {};
  const FileResult<Rig> rig = read_rig(summary.rig_toml, "rig.toml");
  const FileResult<Configuration> configuration = read_configuration(summary.configuration_toml, "azimuth.toml");
  return rig && configuration ? std::string(name(chosen_estimator(*rig, *configuration))) : std::string();
}

std::optional<std::array<double, 4>> shares_of(const std::array<double, 4>& health_s) {
  const double all_s = std::accumulate(health_s.begin(), health_s.end(), 0.0);
  if (!(all_s > 0.0)) return std::nullopt;
  std::array<double, 4> shares = health_s;
  for (double& share : shares) share /= all_s;
  return shares;
}

void add_words(std::string& text, const std::string& words) { text += (text.empty() ? "" : ", ") + words; }

std::string trouble_of(const CatalogueRow& row) {
  const LogSummary& summary = row.summary;
  std::string trouble;
  if (summary.damaged_bytes > 0) add_words(trouble, fmt::format("{} damaged bytes", summary.damaged_bytes));
  if (summary.missing_segments > 0) add_words(trouble, fmt::format("{} missing segments", summary.missing_segments));
  if (summary.lost_events > 0) add_words(trouble, fmt::format("{} events not recorded", summary.lost_events));
  if (summary.malformed > 0)
    add_words(trouble, fmt::format("{} messages that this version cannot read", summary.malformed));
  if (summary.rig_toml.empty())
    add_words(trouble, "no rig.toml");
  else if (row.estimator.empty())
    add_words(trouble, "a rig.toml or azimuth.toml that this version cannot read");
  if (summary.poses == 0) add_words(trouble, "no poses");
  return trouble;
}

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

CatalogueRow row_of(const FoundLog& found, const LogSummary& summary) {
  CatalogueRow row;
  row.found = found;
  row.summary = summary;
  row.start_utc = utc_text(summary.first_us);
  row.duration_s = kMicroseconds * (static_cast<double>(summary.last_us) - static_cast<double>(summary.first_us));
  row.robot = robot_of(summary);
  row.version = summary.version;
  row.estimator = estimator_of(summary);
  row.health = shares_of(summary.health_s);
  row.trouble = trouble_of(row);
  return row;
}

CatalogueRow row_of(const FoundLog& found, const FileErrors& errors) {
  CatalogueRow row;
  row.found = found;
  row.trouble = errors.front().message;
  return row;
}

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
