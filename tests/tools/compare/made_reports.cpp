#include "tests/tools/compare/made_reports.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace azimuth::test {

std::size_t figure(std::string_view key) {
  const auto found = std::ranges::find(figures(), key, &Figure::key);
  EXPECT_NE(found, figures().end()) << key;
  return static_cast<std::size_t>(found - figures().begin());
}

RunReport made_report(const std::string& name, std::initializer_list<std::pair<std::string_view, double>> values,
                      std::uint64_t seed, std::vector<std::string> tags) {
  RunReport report;
  report.name = name;
  report.file = name + "." + std::to_string(seed) + ".json";
  report.seed = seed;
  report.tags = std::move(tags);
  report.values.fill(kNoNumber);
  for (const auto& [key, value] : values) report.values[figure(key)] = value;
  return report;
}

const ComparedRun& run_named(const Comparison& comparison, const std::string& name) {
  const auto found = std::ranges::find(comparison.runs, name, &ComparedRun::name);
  if (found == comparison.runs.end()) throw std::runtime_error("no run " + name);
  return *found;
}

std::vector<std::string> names_with(const Comparison& comparison, Trend trend) {
  std::vector<std::string> names;
  for (const ComparedRun& run : comparison.runs)
    if (run.has(trend)) names.push_back(run.name);
  return names;
}

std::string report_text(const std::string& name, double position_rmse_m) {
  const nlohmann::json share{{"share", 0.25}};
  const nlohmann::json time{{"median", 100}, {"p99", 200}};
  const nlohmann::json report{{"name", name},
                              {"tags", {"lab", "short"}},
                              {"overrides", {"ekf.thinning_s=1"}},
                              {"made_by", "azimuth 1"},
                              {"run", "folder"},
                              {"estimator", "ekf"},
                              {"seed", 7},
                              {"digest", "abc"},
                              {"pose", {{"rmse_m", position_rmse_m}, {"heading_rmse_rad", 0.01}, {"anees", 2.5}}},
                              {"hindsight", nullptr},
                              {"health_over_time", {{"tracking", share}, {"degraded", share}, {"lost", share}}},
                              {"map", {{"rmse_m", 0.2}, {"matched", 9}, {"true_landmarks", 12}, {"duplicates", 1}}},
                              {"association", {{"wrong", 3}, {"judged", 300}}},
                              {"time_us", {{"step", time}, {"detect", {{"median", nullptr}}}}},
                              {"peak_memory_mb", 20.5},
                              {"resident_memory_mb", 18}};
  return report.dump();
}

}  // namespace azimuth::test
