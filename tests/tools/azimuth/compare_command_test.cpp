#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

/// Reports of short simulated drives, replayed by this version as "before" and as "after".
class CompareCommand : public testing::Test {
 protected:
  void replay_all(int runs) {
    for (int seed = 1; seed <= runs; ++seed) {
      const Outcome made = azimuth({"simulate", run(seed), "--world", seed % 2 == 0 ? "lab" : "scattered", "--seed",
                                    std::to_string(seed), "--seconds", "20"});
      ASSERT_EQ(made.code, 0) << made.err;
      replay_one("before", seed);
      replay_one("after", seed);
    }
  }

  std::string place(const std::string& name) { return scratch_ / name; }
  std::string run(int seed) { return place("run" + std::to_string(seed)); }

  void replay_one(const std::string& version, int seed, std::vector<std::string> more = {}) {
    std::filesystem::create_directories(place(version));
    std::vector<std::string> arguments{"replay",
                                       run(seed),
                                       "--quiet",
                                       "--report",
                                       place(version) + "/" + std::to_string(seed) + ".json",
                                       "--name",
                                       "drive " + std::to_string(seed),
                                       "--tag",
                                       seed % 2 == 0 ? "lab" : "scattered"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = azimuth(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  /// The comparison of `version` with "before" as JSON, without the costs, which differ from machine to machine.
  Json compared(const std::string& version, int exit_code) {
    const std::string json = place("compared.json"), page = place("compared.html"), limits = place("limits.toml");
    write_file(limits, "");
    outcome_ = azimuth({"report", "compare", place(version), "--baseline", place("before"), "--json", json, "--html",
                        page, "--limits", limits, "--without-costs"});
    EXPECT_EQ(outcome_.code, exit_code) << outcome_.err;
    return Json::parse(file_bytes(json));
  }

  ScratchFolder scratch_;
  Outcome outcome_;
};

std::vector<std::string> names_that_are(const Json& comparison, const std::string& trend) {
  std::vector<std::string> names;
  for (const Json& run : comparison["runs"])
    for (const Json& figure : run["figures"])
      if (figure["trend"] == trend && (names.empty() || names.back() != run["name"])) names.push_back(run["name"]);
  return names;
}

TEST_F(CompareCommand, OfTwentyRunsTheOneThatGotWorseIsNamedAndOfEqualOnesNone) {
  replay_all(20);
  const Json equal = compared("after", 0);
  ASSERT_EQ(equal["runs"].size(), 20u);
  for (const Json& run : equal["runs"]) EXPECT_EQ(run["digest"], run["digest_before"]);
  for (const char* trend : {"worse", "better", "alike"}) EXPECT_TRUE(names_that_are(equal, trend).empty()) << trend;
  EXPECT_EQ(equal["groups"].size(), 3u);
  EXPECT_NE(outcome_.out.find("compared    20 runs: 0 worse, 0 better, 0 new, 0 missing"), std::string::npos);

  replay_one("after", 6, {"--set", "smoother.inverse_depth_mean_per_m=3"});
  const double before = Json::parse(file_bytes(place("before") + "/6.json"))["pose"]["rmse_m"];
  const double after = Json::parse(file_bytes(place("after") + "/6.json"))["pose"]["rmse_m"];
  ASSERT_GT(after, 1.2 * before) << "the change makes it worse by a fifth";
  const Json worse = compared("after", 1);
  EXPECT_NE(outcome_.err.find("drive 6: position RMSE"), std::string::npos) << outcome_.err;
  EXPECT_EQ(names_that_are(worse, "worse"), std::vector<std::string>{"drive 6"});
  EXPECT_EQ(worse["runs"][0]["name"], "drive 6");
  EXPECT_EQ(worse["past_limits"].size(), std::count(outcome_.err.begin(), outcome_.err.end(), '\n'));
  EXPECT_NE(file_bytes(place("compared.html")).find("drive 6"), std::string::npos);
}

TEST_F(CompareCommand, CutAndMissingReportsAreNamedAndTheRestIsDone) {
  replay_all(3);
  std::filesystem::copy(place("after"), place("less"));
  std::filesystem::remove(place("less") + "/3.json");
  write_file(place("less") + "/2.json", file_bytes(place("after") + "/2.json").substr(0, 200));
  const Outcome outcome = azimuth({"report", "compare", place("less"), "--baseline", place("before")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* line : {"compared    1 run: 0 worse", "2 missing", "missing     drive 3\n", "2.json: is cut short"})
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << "\nis not in\n" << outcome.out;
}

TEST_F(CompareCommand, WithoutCostsTheTablesAreTheSameBitForBit) {
  replay_all(2);
  const auto tables = [&](const std::string& version) {
    const std::string json_file = place("table.json");
    const Outcome outcome = azimuth({"report", "compare", place(version), "--json", json_file, "--without-costs"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out + file_bytes(json_file);
  };
  EXPECT_EQ(tables("before"), tables("after"));
}

TEST_F(CompareCommand, RefusesWhatHasNoReport) {
  const Outcome outcome = azimuth({"report", "compare", one_lap() + "/odometry.csv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("odometry.csv: is cut short, or no JSON"), std::string::npos) << outcome.err;
}

TEST(ReplayReport, HasNameTagsAndOverrides) {
  const ScratchFolder scratch;
  const std::string report = scratch / "report.json";
  ASSERT_EQ(azimuth({"replay", one_lap(), "--quiet", "--report", report, "--name", "monday", "--tag", "lab", "--tag",
                     "short", "--set", "smoother.thinning_s=1"})
                .code,
            0);
  const Json json = Json::parse(file_bytes(report));
  EXPECT_EQ(json["name"], "monday");
  EXPECT_EQ(json["tags"], (Json{"lab", "short"}));
  EXPECT_EQ(json["overrides"], Json{"smoother.thinning_s=1"});
  EXPECT_TRUE(json["made_by"].get<std::string>().starts_with("azimuth "));
  EXPECT_GT(json["resident_memory_mb"].get<double>(), 1.0);
}

}  // namespace
}  // namespace azimuth::test
