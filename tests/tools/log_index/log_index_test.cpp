// Tests the index of the field logs in a folder: its columns, which logs it reads again, and which ones it refuses.

#include <chrono>
#include <fstream>
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "base/files.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/tools/log_index/recorded_log.hpp"
#include "tools/log_index/index_logs.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int8_t kTracking = pose_cov_t::HEALTH_TRACKING, kLost = pose_cov_t::HEALTH_LOST;

class LogIndex : public testing::Test {
 protected:
  fs::path session(const std::string& name) {
    fs::create_directories(folder_ / name);
    return folder_ / name;
  }
  /// A drive of ten seconds and twenty metres in two segments. Its health is "tracking" for nine seconds.
  fs::path drive(const std::string& name, const std::string& prefix = "") {
    const fs::path path = session(name);
    RecordedLog(path / "000.lcm", prefix).mark(0).documents().pose(0, 0, kTracking).pose(4, 10, kTracking);
    RecordedLog(path / "001.lcm", prefix).mark(1).documents().pose(9, 18, kLost).pose(10, 20, kTracking);
    return path;
  }
  IndexResult index() {
    FileResult<IndexResult> result = index_logs(folder_.path(), file_);
    if (result) return *std::move(result);
    ADD_FAILURE() << text(result.error());
    return {};
  }
  std::string refusal(const fs::path& folder) {
    const FileResult<IndexResult> result = index_logs(folder, file_);
    return result ? "" : text(result.error());
  }
  /// The first column of the first row of the answer; "NULL" for an unknown value.
  std::string ask(const std::string& sql) {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    std::string answer = "nothing";
    sqlite3_open(file_.c_str(), &database);
    EXPECT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    if (sqlite3_step(statement) == SQLITE_ROW) {
      const auto* words = reinterpret_cast<const char*>(sqlite3_column_text(statement, 0));
      answer = words == nullptr ? "NULL" : words;
    }
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return answer;
  }
  std::string of(const std::string& path, const std::string& column) {
    return ask("SELECT " + column + " FROM logs WHERE path = '" + path + "'");
  }
  void change(const std::string& sql) {
    sqlite3* database = nullptr;
    sqlite3_open(file_.c_str(), &database);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "logs.sqlite";
};

TEST_F(LogIndex, SaysWhatADriveWas) {
  drive("hall/2026-11-25T12-00-00Z");
  const IndexResult result = index();
  EXPECT_EQ(result.read, 1U);
  EXPECT_TRUE(result.troubles.empty()) << text(result.troubles);
  const std::string path = "hall/2026-11-25T12-00-00Z";
  EXPECT_EQ(of(path, "start_utc"), "2026-11-25T12:00:00Z");
  EXPECT_EQ(of(path, "duration_s"), "10.0");
  EXPECT_EQ(of(path, "version"), "azimuthd 1.2.3");
  EXPECT_EQ(of(path, "estimator"), "fastslam");
  EXPECT_EQ(of(path, "tracking"), "0.9");
  EXPECT_EQ(of(path, "lost"), "0.1");
  EXPECT_EQ(of(path, "distance_m"), "20.0");
  EXPECT_EQ(of(path, "min_x_m || ' ' || min_y_m || ' ' || max_x_m || ' ' || max_y_m"), "0.0 -10.0 20.0 0.0");
  EXPECT_EQ(of(path, "files || ' ' || poses || ' ' || cut"), "2 4 0");
  EXPECT_EQ(of(path, "bytes"),
            std::to_string(fs::file_size(folder_ / path / "000.lcm") + fs::file_size(folder_ / path / "001.lcm")));
  EXPECT_EQ(of(path, "robot"), "NULL") << "it has no name";
  EXPECT_EQ(of(path, "trouble"), "NULL");
  EXPECT_THAT(summary_of(result), HasSubstr("1 logs (1 read, 0 unchanged, 0 vanished, 0 with trouble): 0.0 h"));
}

TEST_F(LogIndex, NamesRobotsByTheirPrefixElseByTheirOdometer) {
  drive("first", "ROBOT7_");
  RecordedLog(folder_ / "second.lcmlog").documents().pose(0, 0, kTracking).odometer("running (p3dx-sh GJC_3156)");
  index();
  EXPECT_EQ(of("first", "robot"), "ROBOT7");
  EXPECT_EQ(of("first", "tracking"), "0.9");
  EXPECT_EQ(of("second.lcmlog", "robot"), "p3dx-sh GJC_3156");
}

TEST_F(LogIndex, CountsPredictedPosesForTimeButNotForTheBox) {
  RecordedLog(folder_ / "one.lcm")
      .documents()
      .pose(0, 0, kTracking)
      .pose(2, 4, kTracking, true)
      .pose(1.9, 3.8, kTracking)  // this step is older than the prediction before it
      .pose(4, 4, kLost, true);
  index();
  EXPECT_EQ(of("one.lcm", "poses"), "2");
  EXPECT_EQ(of("one.lcm", "max_x_m"), "3.8");
  EXPECT_EQ(of("one.lcm", "distance_m"), "4.0") << "no way is driven twice";
  EXPECT_EQ(of("one.lcm", "tracking"), "1.0");
}

TEST_F(LogIndex, SilenceIsNoHealth) {
  RecordedLog(folder_ / "one.lcm").documents().pose(0, 0, kLost).pose(1, 0, kTracking).pose(101, 0, kTracking);
  index();
  EXPECT_EQ(of("one.lcm", "silent_s"), "100.0");
  EXPECT_EQ(of("one.lcm", "lost"), "1.0");
}

TEST_F(LogIndex, ReadsOnlyWhatHasChanged) {
  drive("first");
  drive("second");
  index();
  change("UPDATE logs SET robot = 'as it was'");
  RecordedLog(folder_ / "second/002.lcm").mark(2).documents().pose(11, 21, kTracking);
  const IndexResult again = index();
  EXPECT_EQ(again.read, 1U);
  EXPECT_EQ(again.unchanged, 1U);
  EXPECT_EQ(of("first", "robot"), "as it was");
  EXPECT_EQ(of("second", "robot"), "NULL");
  EXPECT_EQ(of("second", "distance_m"), "21.0");
  fs::last_write_time(folder_ / "first/000.lcm", fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::last_write_time(folder_ / "first/001.lcm", fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_EQ(index().read, 1U) << "of the same size, but of another time";
}

TEST_F(LogIndex, ForgetsWhatHasVanished) {
  drive("first");
  fs::remove_all(drive("second").parent_path() / "nothing");
  index();
  fs::remove_all(folder_ / "second");
  EXPECT_EQ(index().vanished, 1U);
  EXPECT_EQ(of("second", "path"), "nothing");
  EXPECT_EQ(index().unchanged, 1U);
}

TEST_F(LogIndex, CountsImagesApart) {
  const fs::path frames = drive("first") / "frames";
  fs::create_directory(frames);
  RecordedLog(frames / "000.lcm").mark(0);
  EXPECT_EQ(index().totals.logs, 1U);
  EXPECT_EQ(of("first", "image_bytes"), std::to_string(fs::file_size(frames / "000.lcm")));
}

TEST_F(LogIndex, NamesLogsThatAreCutAndDoesTheRest) {
  drive("whole");
  const fs::path cut = drive("cut");
  fs::resize_file(cut / "001.lcm", fs::file_size(cut / "001.lcm") - 7);
  fs::remove(drive("gap") / "000.lcm");
  RecordedLog(session("full") / "000.lcm").mark(0, 12).documents().pose(0, 0, kTracking);
  const IndexResult result = index();
  EXPECT_EQ(result.totals.in_trouble, 3U);
  EXPECT_THAT(text(result.troubles), HasSubstr("/cut: "));
  EXPECT_THAT(of("cut", "trouble"), HasSubstr("damaged bytes"));
  EXPECT_EQ(of("gap", "trouble"), "1 missing segments");
  EXPECT_EQ(of("full", "trouble"), "12 events not recorded");
  EXPECT_EQ(ask("SELECT group_concat(path) FROM (SELECT path FROM logs WHERE cut ORDER BY path)"), "cut,full,gap");
  EXPECT_EQ(of("cut", "distance_m"), "18.0") << "up to where it is cut";
}

TEST_F(LogIndex, NamesLogsOfOtherVersionsAndWithoutARig) {
  const std::array<std::byte, 16> unknown{};
  RecordedLog(folder_ / "older.lcm").documents().raw(channel::kPose, unknown).raw(channel::kStatus, unknown);
  RecordedLog(folder_ / "rigless.lcm").pose(0, 0, kTracking).pose(1, 0, kTracking);
  RecordedLog(folder_ / "odd.lcm").document("rig.toml", "[camera\n").pose(0, 0, 7).pose(1, 1, 7);
  std::ofstream(folder_ / "words.log") << "not a log of LCM\n";
  std::ofstream(folder_ / "empty.lcm").flush();
  const IndexResult result = index();
  EXPECT_EQ(result.troubles.size(), 5U) << text(result.troubles);
  EXPECT_EQ(of("older.lcm", "trouble"), "2 messages that this version cannot read, no poses");
  EXPECT_EQ(of("older.lcm", "distance_m"), "NULL");
  EXPECT_EQ(of("rigless.lcm", "trouble"), "no rig.toml");
  EXPECT_EQ(of("rigless.lcm", "tracking"), "1.0");
  EXPECT_EQ(of("odd.lcm", "trouble"), "a rig.toml or azimuth.toml that this version cannot read");
  EXPECT_EQ(of("odd.lcm", "silent_s"), "1.0") << "a state of health that nobody knows";
  EXPECT_THAT(of("words.log", "trouble"), HasSubstr("is not an LCM log"));
  EXPECT_EQ(of("empty.lcm", "bytes"), "0");
  EXPECT_EQ(index().read, 0U) << "what cannot be read is not tried again";
}

TEST_F(LogIndex, PassesOverPosesThatCannotBe) {
  RecordedLog(folder_ / "one.lcm")
      .documents()
      .pose(0, 0, kTracking)
      .pose(1, std::numeric_limits<double>::quiet_NaN(), kTracking)
      .pose(2, 1e300, kTracking)
      .pose(3, 3, kTracking)
      .pose(-4000, 3, kTracking)  // the clock was set back
      .pose(-3999, 4, kTracking);
  index();
  EXPECT_EQ(of("one.lcm", "distance_m"), "4.0");
  EXPECT_EQ(of("one.lcm", "malformed_messages"), "2");
  EXPECT_EQ(of("one.lcm", "max_x_m"), "4.0");
}

TEST_F(LogIndex, KeepsWhatLiesInFoldersThatCannotBeSearched) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may search everything";
  drive("secret/first");
  index();
  fs::permissions(folder_ / "secret", fs::perms::none);
  const IndexResult result = index();
  fs::permissions(folder_ / "secret", fs::perms::owner_all);
  EXPECT_EQ(result.vanished, 0U);
  EXPECT_THAT(text(result.troubles), HasSubstr("cannot be searched: Permission denied"));
}

TEST_F(LogIndex, RefusesFilesThatAreNoCatalogue) {
  drive("first");
  std::ofstream(file_) << "these are words, and more than a header of them: " << std::string(4096, '.');
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("logs.sqlite: is no catalogue of logs that can be read"));
  fs::remove(file_);
  change("CREATE TABLE addresses (name TEXT)");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is another program's, not a catalogue of logs"));
  EXPECT_EQ(ask("SELECT count(*) FROM sqlite_master"), "1") << "and leaves it as it is";
  fs::remove(file_);
  index();
  change("PRAGMA user_version = 7");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is a catalogue of version 7; this version writes 1"));
}

TEST_F(LogIndex, SaysThatAnotherProcessWritesAndLeavesTheCatalogueAsItIs) {
  drive("first");
  index();
  drive("second");
  sqlite3* other = nullptr;
  sqlite3_open(file_.c_str(), &other);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  const FileResult<IndexResult> result = index_logs(folder_.path(), file_);
  sqlite3_close(other);
  ASSERT_FALSE(result);
  EXPECT_TRUE(is_busy(result.error()));
  EXPECT_EQ(text(result.error()), file_.string() + ": is being written by another process\n");
  EXPECT_EQ(ask("SELECT count(*) FROM logs"), "1");
  EXPECT_EQ(index().read, 1U) << "and goes on when it is free";
}

TEST_F(LogIndex, RefusesACatalogueOfAnotherFolder) {
  const fs::path first = drive("first");
  index();
  EXPECT_THAT(refusal(first), HasSubstr("is the catalogue of another folder, . from where it lies"));
  EXPECT_EQ(of("first", "poses"), "4");
}

TEST_F(LogIndex, ACatalogueMovesWithItsLogs) {
  drive("here/first");
  file_ = folder_ / "here/logs.sqlite";
  ASSERT_TRUE(index_logs(folder_ / "here", file_));
  fs::rename(folder_ / "here", folder_ / "there");
  file_ = folder_ / "there/logs.sqlite";
  const auto moved = index_logs(folder_ / "there", file_);
  ASSERT_TRUE(moved) << text(moved.error());
  EXPECT_EQ(moved->unchanged, 1U);
}

TEST_F(LogIndex, RefusesACatalogueThatIsCutAndLeavesItAsItIs) {
  for (int i = 0; i < 40; ++i)
    RecordedLog(folder_ / ("log" + std::to_string(i) + ".lcm")).documents().pose(0, 0, kLost);
  index();
  fs::resize_file(file_, fs::file_size(file_) / 2);
  const std::string before = *read_text_file(file_);
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is no catalogue of logs that can be read"));
  EXPECT_EQ(*read_text_file(file_), before);
}

}  // namespace
}  // namespace azimuth::test
