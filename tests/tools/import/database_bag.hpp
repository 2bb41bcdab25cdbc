#pragma once
// Writes bags of ROS 2 in SQLite with the layout of rosbag2.

#include <cstdint>
#include <sqlite3.h>
#include <stdexcept>
#include <string>

#include "tests/tools/import/ros2_messages.hpp"

namespace azimuth::test {

/// Thread contract: thread-bound.
class DatabaseBag {
 public:
  explicit DatabaseBag(const std::string& file) {
    if (sqlite3_open(file.c_str(), &database_) != SQLITE_OK) throw std::runtime_error("cannot make " + file);
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
        "data BLOB NOT NULL); BEGIN");
  }
  DatabaseBag(const DatabaseBag&) = delete;
  DatabaseBag& operator=(const DatabaseBag&) = delete;
  ~DatabaseBag() {
    run("COMMIT");
    sqlite3_close(database_);
  }

  void run(const std::string& sql) { sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr); }
  void topic(int id, const std::string& name, const std::string& type, const std::string& format = "cdr") {
    run("INSERT INTO topics VALUES(" + std::to_string(id) + ", '" + name + "', '" + type + "', '" + format + "', '')");
  }
  /// Adds the definition of a type, which databases contain since ROS 2 Iron.
  void definition(const RosType& type) {
    run("CREATE TABLE IF NOT EXISTS message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding "
        "TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)");
    run("INSERT INTO message_definitions VALUES(NULL, '" + type.name + "', 'ros2msg', '" + type.definition + "', '')");
  }
  void message(int topic, double recorded_s, const std::string& data) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_, "INSERT INTO messages VALUES(NULL, ?, ?, ?)", -1, &statement, nullptr);
    sqlite3_bind_int(statement, 1, topic);
    sqlite3_bind_int64(statement, 2, static_cast<std::int64_t>(recorded_s * 1e9 + 0.5));
    sqlite3_bind_blob(statement, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }

 private:
  sqlite3* database_ = nullptr;
};

}  // namespace azimuth::test
