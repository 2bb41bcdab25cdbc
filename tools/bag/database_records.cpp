// Reads ROS 2 bags in SQLite. The tables are topics, messages and, since ROS 2 Iron, message_definitions.

#include <algorithm>
#include <map>
#include <memory>
#include <sqlite3.h>
#include <system_error>

#include "tools/bag/bag_layout.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth {
namespace {

using Database = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;
using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

constexpr int kStepsPerLook = 10'000;         // SQLite instructions between two checks; a message takes about ten
constexpr std::uint64_t kSteps = 10'000'000;  // instructions allowed for any file, in addition to those by its size

/// Limits the work for a file, since a crafted database may keep SQLite busy for ever.
struct Work {
  std::uint64_t left = 0;

  explicit Work(std::uint64_t file_bytes) : left((kSteps + 10 * file_bytes) / kStepsPerLook) {}
  static int look(void* work) {
    std::uint64_t& left = static_cast<Work*>(work)->left;
    return left == 0 ? 1 : (--left, 0);
  }
};

/// Escapes a file name for a URI.
std::string escaped(const std::string& file) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char each : file) {
    const auto byte = static_cast<unsigned char>(each);
    const bool plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || (byte >= '0' && byte <= '9') ||
                       byte == '/' || byte == '.' || byte == '_' || byte == '-';
    if (plain)
      out += each;
    else
      (out += '%') += {kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return out;
}

Database open_database(const std::string& uri) {
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  const int result = sqlite3_open_v2(uri.c_str(), &opened, flags, nullptr);
  Database database(opened, sqlite3_close);
  if (result != SQLITE_OK) return {nullptr, sqlite3_close};
  return database;
}

/// Reads one database. No code of the database runs: views, triggers and functions in its schema are not used.
class DatabaseWalk {
 public:
  DatabaseWalk(const std::filesystem::path& file, std::uint64_t file_bytes, const BagVisitor& visitor)
      : visitor_(visitor), work_(file_bytes), file_bytes_(file_bytes) {
    const std::string uri = "file:" + escaped(std::filesystem::absolute(file).string());
    database_ = open_database(uri);
    // An unclosed recording has a write-ahead log, which cannot be read in a folder without write permission.
    if (!database_ || !is_readable()) database_ = open_database(uri + "?immutable=1");
    if (database_) secure();
  }

  BagDamage read() {
    if (!database_ || !is_table("topics") || !is_table("messages"))
      return damage("holds no tables topics and messages");
    if (is_table("message_definitions")) read_definitions();
    read_topics();
    const int end = read_messages();
    if (end == SQLITE_DONE) return {};
    return damage(end == SQLITE_INTERRUPT ? "takes more work than a file of its size can be worth"
                                          : sqlite3_errmsg(database_.get()));
  }

 private:
  static BagDamage damage(std::string why) { return {.database = std::move(why)}; }

  void secure() {
    sqlite3* const database = database_.get();
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(std::min<std::uint64_t>(longest(), kMaxChunkBytes)));
    sqlite3_progress_handler(database, kStepsPerLook, Work::look, &work_);
  }
  /// Upper limit of the length of a value stored in the file.
  std::uint64_t longest() const { return file_bytes_ + 4096; }

  Statement prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
    return {statement, sqlite3_finalize};
  }
  static int step(const Statement& statement) { return statement ? sqlite3_step(statement.get()) : SQLITE_ERROR; }
  static Bytes bytes(const Statement& statement, int column) {
    const void* const begin = sqlite3_column_blob(statement.get(), column);
    const int size = sqlite3_column_bytes(statement.get(), column);
    return begin == nullptr ? Bytes{} : Bytes(static_cast<const std::byte*>(begin), static_cast<std::size_t>(size));
  }
  static std::string text(const Statement& statement, int column) {
    return std::string(as_text(bytes(statement, column)));
  }

  bool is_readable() const { return step(prepare("SELECT count(*) FROM sqlite_master")) == SQLITE_ROW; }

  /// True for a table stored in the file; false for views and virtual tables.
  bool is_table(const char* name) const {
    const Statement found = prepare("SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = ?");
    if (!found) return false;
    sqlite3_bind_text(found.get(), 1, name, -1, SQLITE_STATIC);
    return step(found) == SQLITE_ROW;
  }

  void read_definitions() {
    const Statement rows = prepare(
        "SELECT topic_type, encoded_message_definition FROM message_definitions WHERE encoding = 'ros2msg' LIMIT 4096");
    while (step(rows) == SQLITE_ROW) definitions_.insert_or_assign(without_msg(text(rows, 0)), text(rows, 1));
  }

  void read_topics() {
    const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics LIMIT 65536");
    while (step(rows) == SQLITE_ROW) {
      std::string type = without_msg(text(rows, 2));
      const std::string format = text(rows, 3);
      const auto found = definitions_.find(type);
      std::string definition = format == "cdr" && found != definitions_.end() ? found->second : std::string();
      if (format != "cdr") type += " (" + format + ')';
      visitor_.connection({static_cast<std::uint32_t>(sqlite3_column_int64(rows.get(), 0)), text(rows, 1), type,
                           definition, definition, RosVersion::two});
    }
  }

  /// Reads the messages. The total size of genuine rows cannot exceed the size of the file.
  int read_messages() {
    const Statement rows = prepare("SELECT topic_id, timestamp, data FROM messages");
    int result = SQLITE_DONE;
    for (std::uint64_t left = longest(), told = left; (result = step(rows)) == SQLITE_ROW;) {
      const Bytes message = bytes(rows, 2);
      if (message.size() >= left) return SQLITE_INTERRUPT;
      left -= message.size() + 1;
      if (visitor_.progress && told - left >= bag::kProgress_B)
        visitor_.progress(static_cast<std::size_t>(longest() - (told = left)), static_cast<std::size_t>(longest()));
      const std::int64_t ns = std::max<std::int64_t>(sqlite3_column_int64(rows.get(), 1), 0);
      visitor_.message(static_cast<std::uint32_t>(sqlite3_column_int64(rows.get(), 0)),
                       stamp_from_us(ns / 1000 + (ns % 1000 + 500) / 1000), message);
    }
    return result;
  }

  const BagVisitor& visitor_;
  Work work_;
  std::uint64_t file_bytes_;
  Database database_{nullptr, sqlite3_close};
  std::map<std::string, std::string> definitions_;
};

}  // namespace

BagDamage visit_database(const std::filesystem::path& file, const BagVisitor& visitor) {
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(file, ignored);
  return DatabaseWalk(file, ignored ? 0 : bytes, visitor).read();
}

}  // namespace azimuth
