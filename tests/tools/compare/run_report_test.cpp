#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tests/tools/compare/made_reports.hpp"
#include "tools/compare/report_files.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;
using test::figure;

TEST(RunReport, HasWhatAReportSays) {
  const FileResult<RunReport> read = read_report(test::report_text("monday", 0.125), "a.json");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->name, "monday");
  EXPECT_EQ(read->tags, (std::vector<std::string>{"lab", "short"}));
  EXPECT_EQ(read->overrides, std::vector<std::string>{"ekf.thinning_s=1"});
  EXPECT_EQ(read->made_by, "azimuth 1");
  EXPECT_EQ(read->digest, "abc");
  EXPECT_EQ(read->seed, 7u);
  EXPECT_FALSE(read->is_older);
  EXPECT_EQ(read->values[figure("position_rmse_m")], 0.125);
  EXPECT_EQ(read->values[figure("map_found_share")], 0.75);
  EXPECT_EQ(read->values[figure("wrong_share")], 0.01);
  EXPECT_EQ(read->values[figure("step_p99_us")], 200.0);
  EXPECT_TRUE(std::isnan(read->values[figure("hindsight_rmse_m")]));
  EXPECT_TRUE(std::isnan(read->values[figure("detect_median_us")]));
}

TEST(RunReport, OlderOnesAreNamedByTheirRun) {
  Json older = Json::parse(test::report_text("monday", 0.1));
  for (const char* key : {"name", "tags", "overrides", "made_by", "resident_memory_mb", "health_over_time"})
    older.erase(key);
  const FileResult<RunReport> read = read_report(older.dump(), "a.json");
  ASSERT_TRUE(read) << text(read.error());
  EXPECT_EQ(read->name, "folder");
  EXPECT_TRUE(read->is_older);
  EXPECT_TRUE(std::isnan(read->values[figure("tracking_share")]));
}

TEST(RunReport, WithoutANameItIsNamedByItsRunAndNotOlder) {
  Json report = Json::parse(test::report_text("monday", 0.1));
  report["name"] = nullptr;
  const FileResult<RunReport> read = read_report(report.dump(), "a.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "folder");
  EXPECT_FALSE(read->is_older);
}

TEST(RunReport, SaysWhyNothingCameOfARun) {
  const FileResult<RunReport> read =
      read_report(R"({"name": "monday", "tags": ["lab"], "failure": "out of memory"})", "a.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->failure, "out of memory");
  EXPECT_EQ(read->tags, std::vector<std::string>{"lab"});
}

TEST(RunReport, IsRefusedWhereverItIsCut) {
  const std::string whole = test::report_text("monday", 0.1);
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    const FileResult<RunReport> read = read_report(whole.substr(0, bytes), "a.json");
    ASSERT_FALSE(read) << bytes;
    EXPECT_NE(text(read.error()).find(bytes == 0 ? "a.json: is empty" : "a.json: is cut short"), std::string::npos);
  }
}

struct BadReport {
  std::string name, path, value, complaint;
};
std::ostream& operator<<(std::ostream& out, const BadReport& bad) { return out << bad.name; }

class BadReports : public testing::TestWithParam<BadReport> {};

TEST_P(BadReports, AreRefusedByWhatIsWrong) {
  Json report = Json::parse(test::report_text("monday", 0.1));
  report[Json::json_pointer(GetParam().path)] = Json::parse(GetParam().value);
  const FileResult<RunReport> read = read_report(report.dump(), "a.json");
  ASSERT_FALSE(read);
  EXPECT_NE(text(read.error()).find(GetParam().complaint), std::string::npos) << text(read.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, BadReports,
    testing::Values(BadReport{"text_for_a_number", "/pose/rmse_m", R"("small")", "pose.rmse_m is neither null"},
                    BadReport{"negative", "/pose/rmse_m", "-0.1", "pose.rmse_m is neither null"},
                    BadReport{"more_than_all", "/map/matched", "13", "map.matched is more than all"},
                    BadReport{"share_above_one", "/health_over_time/tracking/share", "1.5", "tracking.share is more"},
                    BadReport{"no_pose", "/pose", "null", "it has no pose and time_us"},
                    BadReport{"list_for_times", "/time_us", "[]", "it has no pose and time_us"},
                    BadReport{"number_for_a_name", "/name", "3", "name is no text"},
                    BadReport{"long_name", "/name", '"' + std::string(301, 'x') + '"', "name is no text of 300 bytes"},
                    BadReport{"text_for_tags", "/tags", R"("lab")", "tags is no list of texts"},
                    BadReport{"number_in_tags", "/tags", "[1]", "tags is no list of texts"}),
    [](const auto& tested) { return tested.param.name; });

TEST(RunReport, OtherJsonIsNoReport) {
  for (const char* text_of_other : {"[]", "3", "null", "{}", R"({"rows": 3})"})
    EXPECT_FALSE(read_report(text_of_other, "a.json")) << text_of_other;
  const FileResult<RunReport> deep = read_report(std::string(100'000, '['), "a.json");
  ASSERT_FALSE(deep);
  EXPECT_EQ(text(deep.error()), "a.json: is deeper than any report of azimuth replay\n");
}

void write(const std::filesystem::path& file, const std::string& text_of_file) { std::ofstream(file) << text_of_file; }

TEST(Reports, OfAFolderAreReadByNameAndBadOnesNamed) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "b");
  write(folder / "b/2.json", test::report_text("two", 0.2));
  write(folder / "1.json", test::report_text("one", 0.1));
  write(folder / "3.json", test::report_text("three", 0.3).substr(0, 50));
  write(folder / "4.txt", "no report");
  const std::filesystem::path places[] = {folder.path(), folder / "nowhere.json"};
  const Reports reports = read_reports(places);
  ASSERT_EQ(reports.all.size(), 2u);
  EXPECT_EQ(reports.all[0].name, "one");
  EXPECT_EQ(reports.all[1].name, "two");
  ASSERT_EQ(reports.unreadable.size(), 2u);
  EXPECT_NE(reports.unreadable[0].text().find("3.json: is cut short"), std::string::npos);
  EXPECT_NE(reports.unreadable[1].text().find("nowhere.json: cannot be opened"), std::string::npos);
}

TEST(Reports, AnEmptyFolderIsNamed) {
  const test::TemporaryFolder folder;
  const std::filesystem::path places[] = {folder.path()};
  const Reports reports = read_reports(places);
  ASSERT_EQ(reports.unreadable.size(), 1u);
  EXPECT_NE(reports.unreadable[0].text().find("has no report in it"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
