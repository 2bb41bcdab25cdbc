#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

#include "tests/support/temporary_folder.hpp"
#include "tests/tools/bag/seen_in_bag.hpp"
#include "tests/tools/import/database_bag.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

const RosType kString{"std_msgs/msg/String", "string data\n"};

SeenInBag seen_in_database(const fs::path& file) {
  return seen_by([&](const BagVisitor& visitor) { return visit_database(file, visitor); });
}

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}
void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TEST(DatabaseRecords, AreReadInTheirOrder) {
  const TemporaryFolder folder;
  {
    DatabaseBag bag((folder / "a b%#?.db3").string());
    bag.topic(1, "/a", kString.name);
    bag.topic(2, "/b", "own/msg/Thing", "json");
    bag.definition(kString);
    bag.message(1, 12.5, "one");
    bag.message(2, 12.0, "{}");
    bag.message(1, 13.0, "");
  }
  const SeenInBag seen = seen_in_database(folder / "a b%#?.db3");
  EXPECT_EQ(seen.damage.database, "");
  EXPECT_EQ(seen.messages, (std::vector<std::string>{"1@12500000 one", "2@12000000 {}", "1@13000000 "}));
  ASSERT_EQ(seen.connections.size(), 2u);
  EXPECT_EQ(seen.connections[0].type, "std_msgs/String");
  EXPECT_EQ(seen.connections[0].definition, kString.definition);
  EXPECT_EQ(seen.connections[0].version, RosVersion::two);
  EXPECT_EQ(seen.connections[1].type, "own/Thing (json)");
}

TEST(DatabaseRecords, OfARecordingThatWasNeverClosedAreAllThere) {
  const TemporaryFolder folder;
  const fs::path file = folder / "open.db3";
  DatabaseBag bag(file.string());
  bag.run("COMMIT; PRAGMA journal_mode=WAL; BEGIN");
  bag.topic(1, "/a", kString.name);
  bag.message(1, 1.0, "in the log beside it");
  bag.run("COMMIT; BEGIN");
  ASSERT_TRUE(fs::exists(folder / "open.db3-wal"));
  EXPECT_EQ(seen_in_database(file).messages.size(), 1u);
}

TEST(DatabaseRecords, OfOtherDatabasesThereAreNone) {
  const TemporaryFolder folder;
  write(folder / "none.db3", std::string("SQLite format 3\0", 16) + "...");
  EXPECT_NE(seen_in_database(folder / "none.db3").damage.database, "");
  EXPECT_NE(seen_in_database(folder / "not there.db3").damage.database, "");
  {
    DatabaseBag(folder / "view.db3")
        .run(
            "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM "
            "n) "
            "SELECT i AS id, 1 AS topic_id, i AS timestamp, zeroblob(1000000) AS data FROM n");
  }
  const SeenInBag seen = seen_in_database(folder / "view.db3");
  EXPECT_TRUE(seen.messages.empty());
  EXPECT_NE(seen.damage.database, "");
}

/// SQLite can compute a column, so a message may have more bytes than the file holds.
TEST(DatabaseRecords, GiveNoMoreBytesThanTheFileHas) {
  const TemporaryFolder folder;
  {
    DatabaseBag bag(folder / "bomb.db3");
    bag.run(
        "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
        "data BLOB GENERATED ALWAYS AS (zeroblob(8000)))");
    for (int i = 0; i < 1000; ++i) bag.run("INSERT INTO messages(topic_id, timestamp) VALUES(1, 1)");
  }
  std::uint64_t bytes = 0;
  BagVisitor visitor;
  visitor.connection = [](const BagConnection&) {};
  visitor.message = [&](std::uint32_t, Stamp, Bytes message) { bytes += message.size(); };
  EXPECT_NE(visit_database(folder / "bomb.db3", visitor).database, "");
  EXPECT_LE(bytes, fs::file_size(folder / "bomb.db3") + 4096);
}

TEST(DatabaseRecords, OfDamagedBytesAreTheSameEachTimeAndEnd) {
  const TemporaryFolder folder;
  {
    DatabaseBag bag(folder / "good.db3");
    bag.topic(1, "/a", kString.name);
    bag.definition(kString);
    for (int i = 0; i < 200; ++i) bag.message(1, i, std::string(static_cast<std::size_t>(10 * i), 'x'));
  }
  const std::string good = bytes_of(folder / "good.db3");
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): a fixed seed repeats the test
  int damaged = 0, whole = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    for (int changes = 0; changes < 1 + i % 8; ++changes)
      bad[random() % (i % 2 == 0 ? bad.size() : 4096)] = static_cast<char>(random());
    if (i % 7 == 0) bad.resize(random() % bad.size());
    write(folder / "bad.db3", bad);
    const SeenInBag seen = seen_in_database(folder / "bad.db3");
    ++(seen.damage.database.empty() ? whole : damaged);
    EXPECT_EQ(seen.messages, seen_in_database(folder / "bad.db3").messages);
  }
  EXPECT_GT(damaged, 30);
  EXPECT_GT(whole, 30);
}

}  // namespace
}  // namespace azimuth::test
