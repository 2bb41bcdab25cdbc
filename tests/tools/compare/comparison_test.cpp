#include "tools/compare/comparison.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/compare/made_reports.hpp"
#include "tools/compare/compare_json.hpp"
#include "tools/compare/compare_text.hpp"

namespace azimuth {
namespace {

using test::figure;
using test::made_report;
using test::names_with;
using test::run_named;
using Names = std::vector<std::string>;

const CompareSettings kDefaults = default_compare_settings();

Reports reports(std::vector<RunReport> all) { return {std::move(all), {}}; }

FigureChange change_of_one(std::string_view key, double before, double after) {
  const Reports now = reports({made_report("run", {{key, after}})}),
                then = reports({made_report("run", {{key, before}})});
  return compare(now, &then, kDefaults).runs.front().changes[figure(key)];
}

struct Judged {
  std::string name, key;
  double before, after;
  Trend trend;
  double change;
};
std::ostream& operator<<(std::ostream& out, const Judged& judged) { return out << judged.name; }

class Changes : public testing::TestWithParam<Judged> {};

TEST_P(Changes, AreJudgedByTheirLimits) {
  const Judged& judged = GetParam();
  const FigureChange change = change_of_one(judged.key, judged.before, judged.after);
  EXPECT_EQ(change.trend, judged.trend) << to_string(change.trend);
  EXPECT_NEAR(change.change, judged.change, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Hand, Changes,
    testing::Values(Judged{"a_fifth_worse", "position_rmse_m", 0.10, 0.12, Trend::worse, 0.2},
                    Judged{"a_fifth_better", "position_rmse_m", 0.10, 0.08, Trend::better, -0.2},
                    Judged{"a_tenth_is_allowed", "position_rmse_m", 0.10, 0.11, Trend::alike, 0.1},
                    Judged{"equal", "position_rmse_m", 0.10, 0.10, Trend::equal, 0.0},
                    Judged{"less_than_a_millimetre", "position_rmse_m", 0.001, 0.0019, Trend::alike, 0.9},
                    Judged{"anees_too_large", "anees", 3.0, 6.0, Trend::worse, 1.0},
                    Judged{"anees_too_small", "anees", 3.0, 1.5, Trend::worse, 1.0},
                    Judged{"anees_that_is_good_enough", "anees", 3.0, 4.9, Trend::alike, 4.9 / 3.0 - 1.0},
                    Judged{"anees_to_the_other_side", "anees", 1.0, 9.0, Trend::alike, 0.0},
                    Judged{"tracking_lost", "tracking_share", 0.99, 0.96, Trend::worse, 0.03},
                    Judged{"tracking_won", "tracking_share", 0.90, 0.96, Trend::better, -0.06},
                    Judged{"landmarks_not_found", "map_found_share", 1.0, 0.9, Trend::worse, 0.1},
                    Judged{"one_duplicate", "map_duplicates", 0, 1, Trend::worse, 1},
                    Judged{"slower", "step_median_us", 100, 900, Trend::alike, 8},
                    Judged{"more_memory", "peak_memory_mb", 100, 130, Trend::worse, 0.3},
                    Judged{"a_little_more_of_little_memory", "peak_memory_mb", 10, 15, Trend::alike, 0.5}),
    [](const auto& tested) { return tested.param.name; });

TEST(Changes, OfWhatIsNoLongerMeasuredAreNamed) {
  const Reports now = reports({made_report("run", {{"anees", 3}})});
  const Reports then = reports({made_report("run", {{"anees", 3}, {"position_rmse_m", 0.1}})});
  const Comparison comparison = compare(now, &then, kDefaults);
  EXPECT_EQ(comparison.runs[0].changes[figure("position_rmse_m")].trend, Trend::gone);
  EXPECT_NE(comparison_text(comparison).find("position RMSE -, was 0.100 m: no longer measured"), std::string::npos);
  ASSERT_EQ(past_limits(comparison, kDefaults).size(), 1u);
}

TEST(Seeds, OneOfEachIsNotJudgedWhereTheyDiffer) {
  const Reports now = reports({made_report("run", {{"position_rmse_m", 0.2}}, 2)});
  const Reports then = reports({made_report("run", {{"position_rmse_m", 0.1}}, 1)});
  EXPECT_EQ(compare(now, &then, kDefaults).runs[0].changes[0].trend, Trend::unjudged);
}

TEST(Seeds, WhatTheyScatterIsNoTrend) {
  std::vector<RunReport> now, then;
  for (const auto& [seed, value] : {std::pair{1, 0.10}, {2, 0.20}, {3, 0.12}, {4, 0.16}})
    then.push_back(made_report("run", {{"position_rmse_m", value}}, static_cast<std::uint64_t>(seed)));
  for (const auto& [seed, value] : {std::pair{5, 0.22}, {6, 0.11}, {7, 0.21}, {8, 0.20}})
    now.push_back(made_report("run", {{"position_rmse_m", value}}, static_cast<std::uint64_t>(seed)));
  const Reports before = reports(then);
  const FigureChange change = compare(reports(now), &before, kDefaults).runs[0].changes[0];
  EXPECT_NEAR(change.after / change.before - 1.0, 0.276, 1e-3) << "past the limit";
  EXPECT_EQ(change.trend, Trend::alike) << "but not past what seeds do";
}

TEST(Seeds, MoreThanTheyScatterIsWorse) {
  std::vector<RunReport> now, then;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double scatter = 0.001 * static_cast<double>(seed % 3);
    then.push_back(made_report("run", {{"position_rmse_m", 0.10 + scatter}}, seed));
    now.push_back(made_report("run", {{"position_rmse_m", 0.12 + scatter}}, seed + 5));
  }
  const Reports before = reports(then);
  const FigureChange change = compare(reports(now), &before, kDefaults).runs[0].changes[0];
  EXPECT_EQ(change.trend, Trend::worse);
  EXPECT_LT(change.chance, 1e-4);
}

TEST(Comparison, SortsByWhatGotWorse) {
  const Reports now =
      reports({made_report("a", {{"position_rmse_m", 0.09}}), made_report("b", {{"position_rmse_m", 0.3}}),
               made_report("c", {{"position_rmse_m", 0.10}}), made_report("d", {{"position_rmse_m", 0.13}})});
  std::vector<RunReport> all;
  for (const char* name : {"a", "b", "c", "d"}) all.push_back(made_report(name, {{"position_rmse_m", 0.1}}));
  const Reports then = reports(all);
  const Comparison comparison = compare(now, &then, kDefaults);
  Names order;
  for (const ComparedRun& run : comparison.runs) order.push_back(run.name);
  EXPECT_EQ(order, (Names{"b", "d", "c", "a"}));
  EXPECT_EQ(names_with(comparison, Trend::worse), (Names{"b", "d"}));
}

TEST(Comparison, WithoutABaselineTheLeastAccurateIsFirst) {
  const Reports now = reports({made_report("a", {}), made_report("b", {{"position_rmse_m", 0.1}}),
                               made_report("c", {{"position_rmse_m", 0.3}})});
  const Comparison comparison = compare(now, nullptr, kDefaults);
  EXPECT_EQ(comparison.runs[0].name, "c");
  EXPECT_EQ(comparison.runs[2].name, "a");
  EXPECT_TRUE(past_limits(comparison, kDefaults).empty());
}

Comparison with_everything_missing() {
  RunReport failed = made_report("broken", {});
  failed.failure = "killed: out of memory";
  RunReport older = made_report("old", {{"position_rmse_m", 0.1}});
  older.is_older = true;
  RunReport cut = made_report("added", {{"position_rmse_m", 0.1}}), again = made_report("added", {}, 2);
  cut.incomplete = again.incomplete = "51 damaged bytes";
  Reports now = reports({made_report("same", {{"position_rmse_m", 0.1}}),
                         made_report("same", {{"position_rmse_m", 0.2}}), cut, again, failed, older});
  now.unreadable.push_back({"cut.json", 0, "is cut short, or no JSON"});
  const Reports then = reports({made_report("same", {{"position_rmse_m", 0.1}}), made_report("gone", {}), older});
  return compare(now, &then, kDefaults);
}

TEST(Comparison, CountsAndNamesWhatIsMissing) {
  const Comparison comparison = with_everything_missing();
  EXPECT_EQ(comparison.missing, Names{"gone"});
  EXPECT_EQ(comparison.added, Names{"added"});
  ASSERT_EQ(comparison.failed.size(), 1u);
  ASSERT_EQ(comparison.twice.size(), 1u);
  EXPECT_EQ(comparison.twice[0].name, "same");
  EXPECT_EQ(run_named(comparison, "same").changes[0].after, 0.1) << "the first is used";
  EXPECT_EQ(comparison.older.size(), 2u);
  ASSERT_EQ(comparison.incomplete.size(), 1u) << "of two seeds, but of one log";
  EXPECT_EQ(comparison.incomplete[0].name, "added");
  EXPECT_EQ(past_limits(comparison, kDefaults).size(), 4u) << "missing, failed, unreadable, twice";
}

TEST(Comparison, TextAndJsonSayWhatIsMissing) {
  const Comparison comparison = with_everything_missing();
  const std::string table = comparison_text(comparison);
  for (const char* line : {"missing     gone\n", "new         added\n", "failed      broken: killed: out of memory\n",
                           "incomplete  added: 51 damaged bytes\n", "unreadable  cut.json: is cut short",
                           "twice       same: ", "older       2 reports"})
    EXPECT_NE(table.find(line), std::string::npos) << line << "\nis not in\n" << table;
  const auto json = comparison_json(comparison, kDefaults, {}, "azimuth 1");
  EXPECT_EQ(json["absent"]["missing"][0], "gone");
  EXPECT_EQ(json["absent"]["failed"][0]["why"], "killed: out of memory");
  EXPECT_EQ(json["absent"]["incomplete"][0]["why"], "51 damaged bytes");
  EXPECT_EQ(json["absent"]["unreadable"][0]["file"], "cut.json");
  EXPECT_EQ(json["absent"]["twice"][0]["name"], "same");
  const std::string page = comparison_page(json);
  EXPECT_NE(page.find("killed: out of memory"), std::string::npos);
  EXPECT_EQ(page.find("://"), std::string::npos) << "a page that loads something";
}

TEST(Comparison, WithoutCostsTheSameEstimatesGiveTheSameBytes) {
  const Reports slow = reports({made_report("a", {{"position_rmse_m", 0.1}, {"step_median_us", 900}})});
  const Reports fast = reports({made_report("a", {{"position_rmse_m", 0.1}, {"step_median_us", 100}})});
  CompareSettings settings = kDefaults;
  const auto bytes = [&](const Reports& now) {
    return json_text(comparison_json(compare(now, nullptr, settings), settings, {}, "azimuth"), 2);
  };
  EXPECT_NE(bytes(slow), bytes(fast));
  settings.with_costs = false;
  EXPECT_EQ(bytes(slow), bytes(fast));
}

TEST(Comparison, NamesThatAreNoTextAreWrittenAllTheSame) {
  const Reports now = reports({made_report("\xff</script>", {{"position_rmse_m", 0.1}})});
  const Comparison comparison = compare(now, nullptr, kDefaults);
  const auto json = comparison_json(comparison, kDefaults, {}, "azimuth 1");
  EXPECT_TRUE(nlohmann::json::accept(json_text(json, 2)));
  EXPECT_EQ(comparison_page(json).find("\xEF\xBF\xBD</script>"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
